//! Times of streams as seconds since the log's origin.

use crate::quantity::Factor;
use crate::table::Values;

/// Times beyond this are those of a calendar, and are told from the log's beginning [s]. No log lasts as long.
const CALENDAR_S: f64 = 86_400.0;

/// From where a log's times count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Origin {
    /// Whole units of some size, exactly.
    Whole(i64, Factor),
    /// Seconds.
    Seconds(f64),
}

impl Origin {
    /// The origin of a stream's times: their first where they are those of a calendar, else their zero.
    pub(super) fn of(times: &Values, unit: Factor) -> Self {
        let first =
            times.rows().filter(|length| *length > 0).map_or(0.0, |_| unit.apply(times.at(0)));
        match times {
            _ if first.abs() < CALENDAR_S => Self::Seconds(0.0),
            Values::Count(whole) => Self::Whole(whole[0], unit),
            _ => Self::Seconds(first),
        }
    }

    /// Times since the origin [s]; the difference of whole numbers is taken before they are rounded.
    pub(super) fn seconds(self, times: &Values, unit: Factor) -> Vec<f64> {
        match (self, times) {
            (Self::Whole(origin, of), Values::Count(whole)) if of == unit => {
                whole.iter().map(|time| unit.apply(time.saturating_sub(origin) as f64)).collect()
            }
            _ => {
                let origin_s = self.in_seconds();
                let rows = times.rows().unwrap_or(0);
                (0..rows).map(|row| unit.apply(times.at(row)) - origin_s).collect()
            }
        }
    }

    fn in_seconds(self) -> f64 {
        match self {
            Self::Whole(origin, unit) => unit.apply(origin as f64),
            Self::Seconds(origin_s) => origin_s,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stamps_of_a_calendar_keep_their_nanoseconds() {
        let ns: Vec<i64> = (0..3).map(|k| 1_700_000_000_000_000_000 + k * 1_000_001).collect();
        let (times, unit) = (Values::Count(ns), Factor::Over(1e9));
        let origin = Origin::of(&times, unit);
        assert_eq!(origin.seconds(&times, unit), [0.0, 0.001000001, 0.002000002]);
        let seconds = Values::Float(vec![1_700_000_000.5]);
        assert_eq!(origin.seconds(&seconds, Factor::Times(1.0)), [0.5]);
    }

    #[test]
    fn times_that_count_from_a_start_stay() {
        let times = Values::Float(vec![5.0, 5.001]);
        let origin = Origin::of(&times, Factor::Times(1.0));
        assert_eq!(origin.seconds(&times, Factor::Times(1.0)), [5.0, 5.001]);
    }
}
