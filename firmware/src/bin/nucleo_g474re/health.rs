//! The lamp LD2 and the log: how the board is, for people.

use core::sync::atomic::Ordering::Relaxed;

use embassy_stm32::gpio::{Level, Output, Speed};
use embassy_stm32::peripherals::PA5;
use embassy_stm32::{Peri, pac};
use embassy_time::Timer;
use firmware::message::Status;

use crate::exchange::REPORT;

/// Time on and time off [ms].
fn rhythm_ms(status: Status) -> (u64, u64) {
    match status {
        Status { converter_fault: true, .. } => (100, 100),
        Status { running: true, .. } => (900, 100),
        Status { loaded: true, .. } => (500, 500),
        _ => (100, 900),
    }
}

/// Blinks the lamp.
#[embassy_executor::task]
pub async fn show(pin: Peri<'static, PA5>) -> ! {
    let mut lamp = Output::new(pin, Level::Low, Speed::Low);
    loop {
        let (on_ms, off_ms) = rhythm_ms(REPORT.status(true));
        lamp.set_high();
        Timer::after_millis(on_ms).await;
        lamp.set_low();
        Timer::after_millis(off_ms).await;
    }
}

/// Says so if the last run ended badly.
pub fn log_reset() {
    let reset = pac::RCC.csr();
    if reset.read().iwdgrstf() {
        defmt::error!("the watchdog has reset the board");
    }
    reset.modify(|w| w.set_rmvf(true));
}

/// Logs what has changed, at most once a second.
///
/// The log masks interrupts for a few microseconds a line, so it is used sparingly.
#[embassy_executor::task]
pub async fn log() -> ! {
    let mut logged = None;
    loop {
        let status = REPORT.status(true);
        let longest_us = REPORT.longest_tenth_us.load(Relaxed) / 10;
        let overruns = REPORT.overruns.load(Relaxed);
        let now = Some((status, longest_us, overruns));
        if now != logged {
            defmt::info!(
                "loaded {}, running {}, converter fault {}, longest tick {} us, overruns {}",
                status.loaded,
                status.running,
                status.converter_fault,
                longest_us,
                overruns
            );
            logged = now;
        }
        Timer::after_secs(1).await;
    }
}
