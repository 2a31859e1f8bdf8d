//! The controller on the NUCLEO-G474RE.
//!
//! The tick, every millisecond, is an interrupt above everything else; see
//! [`tick`]. The rest, in the thread executor, may be late: the serial line, the
//! flash, the watchdog, the lamp and the log. `docs/board.md` has pins, wiring and times.
#![no_std]
#![no_main]

mod clock_check;
mod clocks;
mod converter;
mod converter_line;
mod drive;
mod encoders;
mod exchange;
mod flash;
mod health;
mod hot_code;
mod latch;
mod link;
mod load;
mod loopback;
mod queue;
mod safe_state;
mod tick;
mod watchdog;

use defmt_rtt as _;
use embassy_executor::Spawner;
use embassy_stm32::peripherals::RNG;
use embassy_stm32::rng::{self, Rng};
use embassy_stm32::{Peri, bind_interrupts};
use firmware::link::BootState;
use panic_probe as _;

use crate::converter::{Converter, ConverterPins};
use crate::drive::{Drive, DrivePins};
use crate::encoders::Encoders;
use crate::link::{Link, LinkPins};
use crate::load::Load;
use crate::loopback::Loopback;
use crate::tick::Wired;
use crate::watchdog::Watchdog;

/// The name in the board's Hello.
const NAME: &str = "nucleo-g474re";

bind_interrupts!(struct Interrupts {
    RNG => rng::InterruptHandler<RNG>;
});

#[embassy_executor::main]
async fn main(spawner: Spawner) {
    let (p, clock_source) = clocks::start();
    clocks::put_tick_above_all();
    let mut store = flash::store(p.FLASH);
    let boot_state = BootState::read(&mut store);
    let watchdog = Watchdog::start(p.IWDG);
    let encoders =
        Encoders::new((p.TIM2, p.PA0, p.PA1), (p.TIM3, p.PA6, p.PA7), (p.TIM1, p.PA8, p.PA9));
    let pins = ConverterPins {
        spi: p.SPI2,
        clock: p.PB13,
        data_out: p.PB15,
        data_in: p.PB14,
        sync: p.PB12,
        clear: p.PB10,
    };
    let converter = Converter::new(pins, Load::new(p.TIM4, p.PB6));
    let drive = Drive::new(DrivePins {
        enable: p.PC6,
        brakes: p.PC9,
        power_good: p.PC8,
        emergency_stop: p.PC5,
    });
    let handler = boot_state.handler(store, NAME, random(p.RNG));
    let loopback = Loopback::where_wired(p.ADC1, (p.PC0, p.PC1, p.PC2));
    let report = health::boot_report(latch::read(), boot_state.report());
    let supervisor = boot_state.supervisor();
    let (remote, records) =
        tick::start(p.TIM6, Wired { encoders, converter, drive, loopback }, supervisor, report);
    // The fault is latched by now; another reset does not forget it.
    health::forget_resets();
    let pins = LinkPins { uart: p.LPUART1, receive: p.PA3, send: p.PA2 };
    let link = Link::new(pins, p.DMA1_CH1, p.DMA1_CH2, handler, remote, records);

    spawner.spawn(defmt::unwrap!(watchdog::watch(watchdog)));
    spawner.spawn(defmt::unwrap!(clock_check::watch()));
    spawner.spawn(defmt::unwrap!(link::serve(link)));
    spawner.spawn(defmt::unwrap!(health::show(p.PA5, clock_source)));
    spawner.spawn(defmt::unwrap!(health::log()));
}

/// Bytes of the chip's random generator.
fn random(peripheral: Peri<'static, RNG>) -> [u8; 16] {
    let mut bytes = [0; 16];
    Rng::new(peripheral, Interrupts).fill_bytes(&mut bytes);
    bytes
}
