//! A stream's values at the times of another.

use crate::quantity::Role;

/// Times that differ by less are the same [s]: a nanosecond's rounding.
const SAME_TIME_S: f64 = 1e-9;

/// Values at the given times; both times increase.
///
/// A command is what the drive holds, so over the interval that begins at a time it is the mean of
/// what was held; a reference is what was last sent; what is measured runs straight between samples.
/// Not a number before the first value.
pub(super) fn at_times(role: Role, from_s: &[f64], values: &[f64], to_s: &[f64]) -> Vec<f64> {
    match role {
        Role::Command => held_means(from_s, values, to_s),
        Role::Reference | Role::Count | Role::Time => {
            to_s.iter().map(|&t| held(from_s, values, t)).collect()
        }
        Role::Position | Role::Velocity | Role::Torque => {
            to_s.iter().map(|&t| between(from_s, values, t)).collect()
        }
    }
}

/// How many of the times are not after `t_s`.
fn count_until(from_s: &[f64], t_s: f64) -> usize {
    from_s.partition_point(|&time_s| time_s <= t_s + SAME_TIME_S)
}

/// The value that was sent last.
pub(super) fn held(from_s: &[f64], values: &[f64], t_s: f64) -> f64 {
    match count_until(from_s, t_s) {
        0 => f64::NAN,
        count => values[count - 1],
    }
}

fn between(from_s: &[f64], values: &[f64], t_s: f64) -> f64 {
    let count = count_until(from_s, t_s);
    if count == 0 {
        return f64::NAN;
    }
    let (before, after) = (count - 1, count.min(from_s.len() - 1));
    let step_s = from_s[after] - from_s[before];
    let part = if step_s > 0.0 { (t_s - from_s[before]) / step_s } else { 0.0 };
    match part.abs() * step_s <= SAME_TIME_S {
        true => values[before],
        false => values[before] + part * (values[after] - values[before]),
    }
}

fn held_means(from_s: &[f64], values: &[f64], to_s: &[f64]) -> Vec<f64> {
    let last_s = to_s.len().checked_sub(2).map_or(0.0, |k| to_s[k + 1] - to_s[k]);
    let end_s = |k: usize| to_s.get(k + 1).copied().unwrap_or(to_s[k] + last_s);
    (0..to_s.len()).map(|k| held_mean(from_s, values, to_s[k], end_s(k))).collect()
}

/// Mean of what is held from one time to another.
fn held_mean(from_s: &[f64], values: &[f64], begin_s: f64, end_s: f64) -> f64 {
    let first = count_until(from_s, begin_s);
    // Changes within the interval, not at its end.
    let end = from_s.partition_point(|&time_s| time_s < end_s - SAME_TIME_S).max(first);
    let at_begin = held(from_s, values, begin_s);
    if end == first || end_s <= begin_s {
        return at_begin;
    }
    let (mut sum, mut now, mut since_s) = (0.0, at_begin, begin_s);
    for k in first..end {
        sum += now * (from_s[k] - since_s);
        (now, since_s) = (values[k], from_s[k]);
    }
    (sum + now * (end_s - since_s)) / (end_s - begin_s)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_are_means_of_what_is_held() {
        let (from_s, values) = ([0.0, 0.5, 1.0, 1.75], [1.0, 3.0, 4.0, 8.0]);
        assert_eq!(at_times(Role::Command, &from_s, &values, &[0.0, 1.0, 2.0]), [2.0, 5.0, 8.0]);
        let same = at_times(Role::Command, &from_s, &values, &from_s);
        assert_eq!(same, values);
        assert!(at_times(Role::Command, &from_s, &values, &[-0.5, 0.0])[0].is_nan());
    }

    #[test]
    fn references_are_held_and_measurements_run_straight() {
        let (from_s, values) = ([0.0, 1.0], [1.0, 3.0]);
        assert_eq!(at_times(Role::Reference, &from_s, &values, &[0.5, 1.5]), [1.0, 3.0]);
        assert_eq!(at_times(Role::Position, &from_s, &values, &[0.0, 0.5, 1.0]), [1.0, 2.0, 3.0]);
        assert!(at_times(Role::Position, &from_s, &values, &[-1.0])[0].is_nan());
    }
}
