//! Ranges of the rig's joints, built into the image: no upload can widen them.

use super::position_limits::PositionLimits;

/// Named at the build: `-3:3,-2.6:0.3,any` [rad].
const RANGES: Option<&str> = option_env!("RRR_RIG_RANGES_RAD");

/// A wrong text ends the build.
const _: () =
    assert!(is_well_formed(RANGES), "RRR_RIG_RANGES_RAD: give LOWER:UPPER or any, thrice");

/// The ranges of the rig that this image was built for.
pub(super) fn of_this_build() -> [Option<PositionLimits>; 3] {
    // A range that cannot be read is one that no block keeps.
    RANGES.map_or([None; 3], |text| ranges(text).unwrap_or([Some(NOWHERE); 3]))
}

const NOWHERE: PositionLimits =
    PositionLimits { lower_rad: f32::MAX, upper_rad: f32::MIN, braking_rad_per_s2: 1.0 };

/// The ranges in a text; none if it is not well formed.
fn ranges(text: &str) -> Option<[Option<PositionLimits>; 3]> {
    let mut ranges = [None; 3];
    let mut parts = text.split(',');
    for range in &mut ranges {
        *range = match parts.next()?.trim() {
            "any" => None,
            part => Some(range_of(part)?),
        };
    }
    parts.next().is_none().then_some(ranges)
}

fn range_of(part: &str) -> Option<PositionLimits> {
    let (lower, upper) = part.split_once(':')?;
    let (lower_rad, upper_rad) = (decimal(lower.trim())?, decimal(upper.trim())?);
    // Only the ends are compared.
    let range = PositionLimits { lower_rad, upper_rad, braking_rad_per_s2: 1.0 };
    range.check(1).is_ok().then_some(range)
}

/// A decimal number of a few digits; the core library's own conversion takes 20 KiB of flash.
fn decimal(text: &str) -> Option<f32> {
    let digits = text.strip_prefix('-').unwrap_or(text);
    let (mut value, mut scale, mut is_fraction) = (0.0_f32, 1.0_f32, false);
    for byte in digits.bytes() {
        match byte {
            b'.' if !is_fraction => is_fraction = true,
            b'0'..=b'9' => {
                value = 10.0 * value + f32::from(byte - b'0');
                scale *= if is_fraction { 10.0 } else { 1.0 };
            }
            _ => return None,
        }
    }
    let sign = if digits.len() < text.len() { -1.0 } else { 1.0 };
    digits.bytes().any(|byte| byte.is_ascii_digit()).then_some(sign * value / scale)
}

/// Whether a text has the signs of three ranges; what the numbers are is seen when they are read.
const fn is_well_formed(text: Option<&str>) -> bool {
    let Some(text) = text else { return true };
    let (bytes, mut commas, mut i) = (text.as_bytes(), 0, 0);
    while i < bytes.len() {
        match bytes[i] {
            b',' => commas += 1,
            b'0'..=b'9' | b'.' | b'-' | b':' | b' ' | b'a' | b'n' | b'y' => {}
            _ => return false,
        }
        i += 1;
    }
    commas == 2
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_ranges_or_any_are_read_and_all_else_is_refused() {
        let found = ranges("-3:3, -2.6:0.3,any").expect("three");
        let ends = found.map(|range| range.map(|range| (range.lower_rad, range.upper_rad)));
        assert_eq!(ends, [Some((-3.0, 3.0)), Some((-2.6, 0.3)), None]);
        for wrong in [
            "",
            "-1:1",
            "any,any",
            "1:-1,any,any",
            "1.2.3:4,any,any",
            "-:.,any,any",
            "x:1,any,any",
            "any,any,any,any",
        ] {
            assert_eq!(ranges(wrong), None, "{wrong}");
        }
        assert!(is_well_formed(None) && is_well_formed(Some("-3:3,any,any")));
        assert!(!is_well_formed(Some("-3:3,any")) && !is_well_formed(Some("-3;3,any,any")));
    }
}
