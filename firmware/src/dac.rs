//! From volts to the codes of a 16-bit bipolar converter.

use serde::{Deserialize, Serialize};

/// The converter's range: codes span [-10 V, 10 V).
pub const FULL_SCALE_V: f32 = 10.0;
/// Voltage of one step, 0.305 mV.
pub const VOLTS_PER_LSB: f32 = FULL_SCALE_V / 32_768.0;

/// A code in two's complement: 0 is 0 V.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct DacCode(pub i16);

impl DacCode {
    /// The code nearest to a voltage, limited to the converter's range.
    #[inline]
    pub fn from_volts(voltage_v: f32) -> Self {
        let scaled = voltage_v * (1.0 / VOLTS_PER_LSB);
        let rounded = (scaled + 0.5_f32.copysign(scaled)) as i32;
        Self(rounded.clamp(i32::from(i16::MIN), i32::from(i16::MAX)) as i16)
    }

    /// The voltage that the converter puts out.
    #[inline]
    pub fn to_volts(self) -> f32 {
        f32::from(self.0) * VOLTS_PER_LSB
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_errs_by_half_a_step() {
        let voltages = (-9990..=9990).map(|mv| mv as f32 * 1e-3);
        let worst =
            voltages.map(|v| (DacCode::from_volts(v).to_volts() - v).abs()).fold(0.0, f32::max);
        assert!(worst <= 0.501 * VOLTS_PER_LSB, "{worst}");
    }

    #[test]
    fn the_range_ends_at_its_ends() {
        assert_eq!(DacCode::from_volts(99.0), DacCode(i16::MAX));
        assert_eq!(DacCode::from_volts(-10.0), DacCode(i16::MIN));
        assert_eq!(DacCode::from_volts(f32::NAN), DacCode(0));
    }
}
