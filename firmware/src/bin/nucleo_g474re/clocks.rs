//! Clocks and who may interrupt whom.

use embassy_stm32::Config;
use embassy_stm32::interrupt::{self, InterruptExt, Priority};
use embassy_stm32::rcc::{Hse, HseMode, Pll, PllMul, PllPreDiv, PllRDiv, PllSource, Sysclk};
use embassy_stm32::time::Hertz;

/// The crystal X3 of the board.
const CRYSTAL: Hertz = Hertz(24_000_000);
/// All but the tick.
const SLOW: Priority = Priority::P6;

/// 170 MHz for the core, both buses and all timers.
pub fn config() -> Config {
    let mut config = Config::default();
    config.rcc.hse = Some(Hse { freq: CRYSTAL, mode: HseMode::Oscillator });
    config.rcc.pll = Some(Pll {
        source: PllSource::HSE,
        prediv: PllPreDiv::DIV6,
        mul: PllMul::MUL85,
        divp: None,
        divq: None,
        divr: Some(PllRDiv::DIV2),
    });
    config.rcc.sys = Sysclk::PLL1_R;
    // Above 150 MHz the core needs the higher voltage.
    config.rcc.boost = true;
    config.bdma_interrupt_priority = SLOW;
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
