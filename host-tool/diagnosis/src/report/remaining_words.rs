//! What remains, in words.

use super::words::{axis_words, percent};
use crate::result::{Axis, Gap, Remainder};

/// Most entries that are said.
const MOST_SAID: usize = 3;
/// Part of the gap from which something is said.
const SAID: f64 = 0.005;

/// "The rest, 4 %: joint 2 over velocity, friction below 0.02 rad/s."; none where it is nothing.
pub(super) fn remaining(remainder: &[Remainder], rest: f64) -> Option<String> {
    let large: Vec<&Remainder> =
        remainder.iter().filter(|entry| entry.share >= SAID).take(MOST_SAID).collect();
    let words = |entry: &&Remainder| match large.len() {
        1 => place_words(entry),
        _ => format!("{} ({} %)", place_words(entry), percent(entry.share)),
    };
    let said: Vec<String> = large.iter().map(words).collect();
    match said.as_slice() {
        _ if rest < SAID => None,
        [] => Some(format!("The rest, {} %, varies with none of the axes.", percent(rest))),
        said => Some(format!("The rest, {} %: {}.", percent(rest), said.join("; "))),
    }
}

/// Joint, axis and course; the axis is not said twice.
pub fn place_words(entry: &Remainder) -> String {
    let axis = axis_words(entry.axis);
    if entry.axis == Axis::Offset || entry.detail.contains(axis) {
        return format!("joint {}, {}", entry.joint, entry.detail);
    }
    format!("joint {} over {axis}, {}", entry.joint, entry.detail)
}

/// Part of the squares above the noise that all causes together leave, on the confirming logs.
pub fn rest_part(gap: &Gap) -> f64 {
    let above = |values_v: &[f64]| -> f64 {
        let pairs = values_v.iter().zip(&gap.noise_floor_v);
        pairs.map(|(value_v, noise_v)| (value_v.powi(2) - noise_v.powi(2)).max(0.0)).sum()
    };
    let whole_v2 = above(&gap.refitted_v);
    if whole_v2 > 0.0 { above(&gap.with_effects_v) / whole_v2 } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::slow_friction;

    #[test]
    fn what_remains_is_said_with_its_place() {
        let said = remaining(&[slow_friction()], 0.04).unwrap();
        assert_eq!(said, "The rest, 4 %: joint 2 over velocity, friction below 0.02 rad/s.");
        let offset = Remainder {
            joint: 1,
            axis: Axis::Offset,
            share: 0.01,
            detail: "constant, 3 mV".into(),
            ..slow_friction()
        };
        let said = remaining(&[slow_friction(), offset], 0.06).unwrap();
        assert!(said.ends_with("0.02 rad/s (4 %); joint 1, constant, 3 mV (1 %)."), "{said}");
        assert!(remaining(&[], 0.06).unwrap().contains("none of the axes"));
        assert_eq!(remaining(&[], 0.001), None);
    }

    #[test]
    fn the_rest_is_a_part_of_the_squares_above_the_noise() {
        let gap = Gap {
            refitted_v: vec![5.0, 1.0],
            with_effects_v: vec![13f64.sqrt(), 0.9],
            noise_floor_v: vec![1.0, 1.0],
            ..Gap::default()
        };
        assert!((rest_part(&gap) - 0.5).abs() < 1e-12);
        assert_eq!(rest_part(&Gap::default()), 0.0);
    }
}
