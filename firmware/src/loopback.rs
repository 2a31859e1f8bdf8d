//! The converter's outputs, measured: from the counts of an ADC behind a divider to volts.
//!
//! ```text
//! output --- 33 kOhm ---+--- ADC, 12 bits of 0 to 3.3 V
//!                       |
//!    3.3 V --- 10 kOhm -+- 15 kOhm --- ground; 10 nF beside it
//! ```
//!
//! It brings -10 to 10 V to 0.14 to 3.21 V. The counts have 3.3 V as their measure, as the divider's
//! middle does: only the resistors and the measure itself are wrong, by 1 % and 2 %.

/// Counts of the whole range.
const FULL_SCALE: f32 = 4096.0;
/// What they measure with, and what pulls the divider up [V].
const SUPPLY_V: f32 = 3.3;
/// The divider: from the output, to the supply, to ground [1/kOhm].
const FROM_OUTPUT: f32 = 1.0 / 33.0;
const TO_SUPPLY: f32 = 1.0 / 10.0;
const TO_GROUND: f32 = 1.0 / 15.0;
const SUM: f32 = FROM_OUTPUT + TO_SUPPLY + TO_GROUND;

/// Volts at the output of a count.
const V_PER_COUNT: f32 = SUPPLY_V / FULL_SCALE * SUM / FROM_OUTPUT;
/// And those of no count.
const ZERO_COUNT_V: f32 = -SUPPLY_V * TO_SUPPLY / FROM_OUTPUT;

/// The voltage at an output, from the counts behind its divider [V].
#[inline]
pub fn volts(counts: u16) -> f32 {
    f32::from(counts) * V_PER_COUNT + ZERO_COUNT_V
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::HardLimits;

    /// Counts behind a divider whose parts are off by these shares.
    fn counts(output_v: f32, off: [f32; 3], supply_v: f32) -> u16 {
        let parts = [FROM_OUTPUT, TO_SUPPLY, TO_GROUND];
        let g = [0, 1, 2].map(|i| parts[i] / (1.0 + off[i]));
        let at_pin_v = (g[0] * output_v + g[1] * supply_v) / (g[0] + g[1] + g[2]);
        (at_pin_v / supply_v * FULL_SCALE) as u16
    }

    #[test]
    fn the_range_of_the_converter_fits_that_of_the_adc_and_comes_back() {
        for output_v in [-10.0, -3.3, 0.0, 0.5, 10.0] {
            let measured = counts(output_v, [0.0; 3], SUPPLY_V);
            assert!((150..=4000).contains(&measured), "{output_v} V: {measured}");
            assert!((volts(measured) - output_v).abs() < 6e-3, "{output_v}: {}", volts(measured));
        }
    }

    #[test]
    fn parts_within_their_tolerance_stay_below_the_limit() {
        let limit_v = HardLimits::default().output_error_v;
        let mut worst = 0.0_f32;
        for number in 0..16 {
            let sign = |bit: u32| if number >> bit & 1 == 1 { 0.01 } else { -0.01 };
            let supply_v = SUPPLY_V * (1.0 + 2.0 * sign(3));
            for output_v in [-10.0, 0.0, 10.0] {
                let measured = volts(counts(output_v, [sign(0), sign(1), sign(2)], supply_v));
                worst = worst.max((measured - output_v).abs());
            }
        }
        assert!(worst > 0.4 && worst < 0.55 && worst < limit_v, "{worst}");
    }

    #[test]
    fn an_adc_that_counts_nothing_is_beyond_every_code() {
        assert!(volts(0) < -10.0 - HardLimits::default().output_error_v);
    }
}
