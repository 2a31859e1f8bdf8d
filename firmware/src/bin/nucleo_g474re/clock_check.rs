//! The clock that ticks, held against the watchdog's, which LPTIM1 counts.

use core::sync::atomic::Ordering::Relaxed;

use embassy_stm32::pac;
use embassy_time::{Instant, Timer};
use firmware::clock_check::clocks_agree;

use crate::exchange::SHARED;

const CHECK_EVERY_MS: u64 = 100;

/// Compares both clocks again and again; the tick makes a fault of it.
#[embassy_executor::task]
pub async fn watch() -> ! {
    start_counting();
    let mut seen = (Instant::now(), counts());
    loop {
        Timer::after_millis(CHECK_EVERY_MS).await;
        let now = (Instant::now(), counts());
        let elapsed_us = (now.0 - seen.0).as_micros() as u32;
        let agree = clocks_agree(elapsed_us, u32::from(now.1.wrapping_sub(seen.1)));
        SHARED.clock_wrong.store(!agree, Relaxed);
        seen = now;
    }
}

/// RM0440, 33.4.12: the register of the last count can be written while the timer is enabled only.
fn start_counting() {
    pac::RCC.apb1enr1().modify(|w| w.set_lptim1en(true));
    let timer = pac::LPTIM1;
    timer.cr().write(|w| w.set_enable(true));
    timer.arr().write(|w| w.set_arr(u16::MAX));
    timer.cr().write(|w| {
        w.set_enable(true);
        w.set_cntstrt(true);
    });
}

/// Its clock is not the core's: a count is right where two reads are the same (RM0440, 33.7.8).
fn counts() -> u16 {
    let read = || pac::LPTIM1.cnt().read().cnt();
    let mut last = read();
    loop {
        let now = read();
        if now == last {
            return now;
        }
        last = now;
    }
}
