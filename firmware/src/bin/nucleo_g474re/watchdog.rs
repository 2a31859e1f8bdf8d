//! The independent watchdog: no ticks, no board.
//!
//! Its reset makes the pins float, the resistor pulls CLR low, and the outputs go
//! to 0 V. It also runs while a debugger holds the core.

use core::sync::atomic::Ordering::Relaxed;

use embassy_stm32::pac::iwdg::vals::Key;
use embassy_stm32::peripherals::IWDG;
use embassy_stm32::wdg::IndependentWatchdog;
use embassy_stm32::{Peri, pac};
use embassy_time::Timer;

use crate::exchange::SHARED;

/// Its clock of 32 kHz is true to 5 %, and erasing a page of the flash takes up to 25 ms.
const TIMEOUT_US: u32 = 32_000;
const CHECK_EVERY_MS: u64 = 5;
/// Fewer ticks than this between two checks, of five due, are a failure.
const TICKS_AT_LEAST: u32 = 3;

/// The watchdog, running.
pub struct Watchdog(IndependentWatchdog<'static, IWDG>);

impl Watchdog {
    /// Starts it: from here on a reset follows unless [`watch`] pets it in time.
    pub fn start(peripheral: Peri<'static, IWDG>) -> Self {
        let mut watchdog = IndependentWatchdog::new(peripheral, TIMEOUT_US);
        watchdog.unleash();
        Self(watchdog)
    }
}

/// Pets the watchdog as long as the ticks go on.
#[embassy_executor::task]
pub async fn watch(mut watchdog: Watchdog) -> ! {
    let mut seen = SHARED.ticks.load(Relaxed);
    loop {
        Timer::after_millis(CHECK_EVERY_MS).await;
        let ticks = SHARED.ticks.load(Relaxed);
        if ticks.wrapping_sub(seen) >= TICKS_AT_LEAST {
            watchdog.0.pet();
        }
        seen = ticks;
    }
}

/// Pets the watchdog before the thread waits for the flash, which it may for 25 ms.
pub fn pet_before_waiting() {
    pac::IWDG.kr().write(|w| w.set_key(Key::RESET));
}
