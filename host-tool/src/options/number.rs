//! Numbers on the command line: finite, and in the range in which they mean something.

use std::fmt::Display;
use std::ops::RangeInclusive;
use std::str::FromStr;

/// Largest noise of an amplifier [V rms]: that of its whole range.
const LOUDEST_V: f64 = 10.0;

/// A number of a range; infinity and what is no number are in none.
fn within<T>(text: &str, range: RangeInclusive<T>, unit: &str) -> Result<T, String>
where
    T: FromStr + PartialOrd + Display,
{
    let (least, most) = (range.start(), range.end());
    match text.parse() {
        Ok(number) if range.contains(&number) => Ok(number),
        _ => Err(format!("must be a number from {least} to {most}{unit}")),
    }
}

/// Noise of an amplifier [V rms].
///
/// # Errors
/// Says what it must be.
pub fn noise_v(text: &str) -> Result<f64, String> {
    within(text, 0.0..=LOUDEST_V, " V")
}

/// The same in millivolts.
///
/// # Errors
/// Says what it must be.
pub fn noise_mv(text: &str) -> Result<f64, String> {
    within(text, 0.0..=1e3, " mV")
}

/// A factor on durations.
///
/// # Errors
/// Says what it must be.
pub fn duration_scale(text: &str) -> Result<f64, String> {
    within(text, 0.2..=20.0, "")
}

/// A duration of a run [s].
///
/// # Errors
/// Says what it must be.
pub fn duration_s(text: &str) -> Result<f32, String> {
    within(text, 1.0..=3600.0, " s")
}

/// A part in per cent.
///
/// # Errors
/// Says what it must be.
pub fn percent(text: &str) -> Result<f64, String> {
    within(text, 0.0..=1e4, " %")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_number_is_infinite_or_none() {
        for text in ["nan", "inf", "-inf", "1e999", "-1", "", "much"] {
            assert!(noise_v(text).is_err() && noise_mv(text).is_err(), "{text}");
            assert!(duration_s(text).is_err(), "{text}");
            assert!(duration_scale(text).is_err() && percent(text).is_err(), "{text}");
        }
        assert_eq!(noise_v("0.004"), Ok(0.004));
    }
}
