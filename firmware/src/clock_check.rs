//! Whether the clock that ticks is true, by the other clock of the chip.
//!
//! The tick, and with it every velocity and every reference, goes by the crystal. The watchdog goes
//! by an oscillator of its own, 32 kHz, true to 8 % over all temperatures and supplies
//! (STM32G474 data sheet, LSI oscillator). A crystal at another overtone, a PLL that has lost it, a
//! divider that a disturbance has changed: they are found by a comparison of the two.

/// The watchdog's clock [Hz].
pub const WATCHDOG_CLOCK_HZ: u32 = 32_000;
/// What both clocks together may be wrong by [%]: 8 of the watchdog's, 1 of the chip's own
/// oscillator where the crystal is missing, 1 for when they are read.
pub const MOST_APART_PERCENT: u32 = 10;

/// Whether so many counts of the watchdog's clock fit a time that the ticking clock has measured.
pub fn clocks_agree(elapsed_us: u32, counts: u32) -> bool {
    let due = (u64::from(elapsed_us) * u64::from(WATCHDOG_CLOCK_HZ) / 1_000_000) as u32;
    let apart = counts.abs_diff(due);
    100 * apart <= MOST_APART_PERCENT * due
}

#[cfg(test)]
mod tests {
    use super::clocks_agree;

    #[test]
    fn clocks_may_differ_by_what_their_data_sheets_allow_and_no_more() {
        let of_100_ms = |counts| clocks_agree(100_000, counts);
        // 29.5 to 34 kHz, as the data sheet has it.
        assert!(of_100_ms(2950) && of_100_ms(3200) && of_100_ms(3400));
        assert!(!of_100_ms(2870) && !of_100_ms(3530));
        // No clock at all, or the crystal three times as fast.
        assert!(!of_100_ms(0) && !of_100_ms(1067));
        assert!(clocks_agree(1_000_000, 32_000) && !clocks_agree(1_000_000, 27_000));
    }
}
