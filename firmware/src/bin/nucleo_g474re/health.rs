//! The lamp LD2 and the log: how the board is, for people.

use core::sync::atomic::Ordering::Relaxed;

use embassy_stm32::gpio::{Level, Output, Speed};
use embassy_stm32::peripherals::PA5;
use embassy_stm32::{Peri, pac};
use embassy_time::Timer;
use firmware::supervisor::{BootReport, Kept, State};

use crate::clocks::Source;
use crate::exchange::SHARED;

/// Time on and time off [ms].
fn rhythm_ms(state: State) -> (u64, u64) {
    match state {
        State::Faulted => (100, 100),
        State::Running | State::Stopping => (900, 100),
        State::Armed => (500, 500),
        State::Boot | State::Disarmed => (100, 900),
    }
}

/// Time that the lamp is off in the middle of its light where the crystal is missing [ms].
const GAP_MS: u64 = 40;

/// Blinks the lamp; each light is two where the clock does not come from the crystal.
#[embassy_executor::task]
pub async fn show(pin: Peri<'static, PA5>, source: Source) -> ! {
    if source == Source::Internal {
        defmt::error!("the crystal does not start: times are true to one in a hundred only");
    }
    let mut lamp = Output::new(pin, Level::Low, Speed::Low);
    loop {
        let (on_ms, off_ms) = rhythm_ms(SHARED.state());
        lamp.set_high();
        if source == Source::Internal {
            Timer::after_millis((on_ms - GAP_MS) / 2).await;
            lamp.set_low();
            Timer::after_millis(GAP_MS).await;
            lamp.set_high();
            Timer::after_millis((on_ms - GAP_MS) / 2).await;
        } else {
            Timer::after_millis(on_ms).await;
        }
        lamp.set_low();
        Timer::after_millis(off_ms).await;
    }
}

/// What the boot has found: in the flash, in the memory that a reset leaves alone, and why there was
/// a reset.
pub fn boot_report(kept: Kept, of_flash: BootReport) -> BootReport {
    let cause = pac::RCC.csr().read();
    let report = BootReport {
        latched: of_flash.latched.or(kept.fault()),
        watchdog_reset: cause.iwdgrstf(),
        was_armed: kept == Kept::Armed,
        supply_failed: cause.borrstf(),
        position_lost: true,
        ..of_flash
    };
    if report.watchdog_reset {
        defmt::error!("the watchdog has reset the board");
    }
    report
}

/// Forgets what caused the last reset.
pub fn forget_resets() {
    pac::RCC.csr().modify(|w| w.set_rmvf(true));
}

/// Logs what has changed, at most once a second.
///
/// The log masks interrupts for a few microseconds a line, so it is used sparingly.
#[embassy_executor::task]
pub async fn log() -> ! {
    let mut logged = None;
    loop {
        let state = SHARED.state();
        let longest_us = SHARED.longest_tenth_us.load(Relaxed) / 10;
        let overruns = SHARED.overruns.load(Relaxed);
        let dropped = SHARED.records_dropped.load(Relaxed);
        let now = Some((state, longest_us, overruns));
        if now != logged {
            defmt::info!(
                "{}, longest tick {} us, overruns {}, records dropped {}",
                state.name(),
                longest_us,
                overruns,
                dropped
            );
            logged = now;
        }
        Timer::after_secs(1).await;
    }
}
