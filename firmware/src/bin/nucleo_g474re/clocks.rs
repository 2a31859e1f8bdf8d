//! Clocks and who may interrupt whom.

use cortex_m::asm;
use embassy_stm32::interrupt::{self, InterruptExt, Priority};
use embassy_stm32::rcc::{self, Hse, HseMode, Pll, PllMul, PllPreDiv, PllRDiv, PllSource, Sysclk};
use embassy_stm32::time::Hertz;
use embassy_stm32::{Peripherals, pac};

/// The crystal X3 of the board.
const CRYSTAL: Hertz = Hertz(24_000_000);
/// The crystal has 100 ms to start, ten times what its data sheet says; at 16 MHz.
const CRYSTAL_LOOKS: u32 = 1000;
const CRYSTAL_LOOK_CYCLES: u32 = 1600;
/// R1MODE of PWR_CR5: while it is set, the core has the voltage for 150 MHz only.
const NORMAL_VOLTAGE: u32 = 1 << 8;
/// All but the tick.
const SLOW: Priority = Priority::P6;

/// What the clock of the core comes from.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// The crystal, true to some parts in a hundred thousand.
    Crystal,
    /// The oscillator of 16 MHz within the chip, true to one in a hundred: there is no crystal, or
    /// it is broken.
    Internal,
}

/// Begins at 16 MHz, raises the core's voltage, then its clock.
pub fn start() -> (Peripherals, Source) {
    let mut config = embassy_stm32::Config::default();
    config.bdma_interrupt_priority = SLOW;
    let mut peripherals = embassy_stm32::init(config);
    let source = if crystal_starts() { Source::Crystal } else { Source::Internal };
    raise_core_voltage();
    rcc::reinit(full_speed(source), &mut peripherals.RCC);
    // A crystal that fails from here on raises the NMI; the chip goes on at 16 MHz by itself.
    pac::RCC.cr().modify(|w| w.set_csson(source == Source::Crystal));
    (peripherals, source)
}

/// Whether the crystal oscillates within its time: the driver would wait for it for ever.
fn crystal_starts() -> bool {
    pac::RCC.cr().modify(|w| w.set_hseon(true));
    for _ in 0..CRYSTAL_LOOKS {
        if pac::RCC.cr().read().hserdy() {
            return true;
        }
        asm::delay(CRYSTAL_LOOK_CYCLES);
    }
    pac::RCC.cr().modify(|w| w.set_hseon(false));
    false
}

/// Gives the core the voltage for 170 MHz.
///
/// `boost` of the driver means the same, but stm32-metapac 21 clears bit 0 of the register where
/// RM0440, 6.4.23, has bit 8; and `init` resets the register, so it cannot be set before.
fn raise_core_voltage() {
    pac::PWR.cr5().modify(|w| w.0 &= !NORMAL_VOLTAGE);
}

/// 170 MHz for the core, both buses and all timers, from 4 MHz of either source.
fn full_speed(source: Source) -> rcc::Config {
    let mut config = rcc::Config::default();
    let (pll_source, prediv) = match source {
        Source::Crystal => (PllSource::HSE, PllPreDiv::DIV6),
        Source::Internal => (PllSource::HSI, PllPreDiv::DIV4),
    };
    if source == Source::Crystal {
        config.hse = Some(Hse { freq: CRYSTAL, mode: HseMode::Oscillator });
    }
    config.pll = Some(Pll {
        source: pll_source,
        prediv,
        mul: PllMul::MUL85,
        divp: None,
        divq: None,
        divr: Some(PllRDiv::DIV2),
    });
    config.sys = Sysclk::PLL1_R;
    // What the crystal is held against, see `clock_check`.
    config.mux.lptim1sel = rcc::mux::Lptimsel::LSI;
    // Above 150 MHz the core needs the higher voltage.
    config.boost = true;
    config
}

/// Interrupts start out all alike; from here on only the tick is at the top.
pub fn put_tick_above_all() {
    interrupt::TIM6_DAC.set_priority(Priority::P0);
    interrupt::LPUART1.set_priority(SLOW);
    interrupt::RNG.set_priority(SLOW);
    // The clock of the executor, see the feature time-driver-tim5.
    interrupt::TIM5.set_priority(SLOW);
}
