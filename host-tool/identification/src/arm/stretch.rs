//! Stretches of a log without gaps, on an even clock.

use files::ArmLog;
use recordings::smoothed::typical_period_s;
use recordings::unbroken;

/// A stretch of a log, evenly sampled.
#[derive(Clone, Debug, PartialEq)]
pub struct Stretch {
    /// Time between samples [s].
    pub period_s: f64,
    /// Positions per joint [rad; m].
    pub position: Vec<Vec<f64>>,
    /// Commands per joint [V; A; Nm; N].
    pub command: Vec<Vec<f64>>,
}

impl Stretch {
    /// How many samples there are.
    pub fn len(&self) -> usize {
        self.position.first().map_or(0, Vec::len)
    }

    /// Its duration [s].
    pub fn duration_s(&self) -> f64 {
        self.len() as f64 * self.period_s
    }
}

/// The stretches of a log whose samples are at most so many typical periods apart.
pub fn stretches(log: &ArmLog, longest_gap: f64) -> Vec<Stretch> {
    let period_s = typical_period_s(&log.time_s);
    let ranges = unbroken(&log.time_s, longest_gap * period_s);
    let long = ranges.into_iter().filter(|range| range.len() > 2);
    long.map(|range| {
        let clock = Clock::of(&log.time_s[range.clone()], period_s);
        let even = |values: &Vec<f64>| clock.sample(&values[range.clone()]);
        Stretch {
            period_s,
            position: log.joints.iter().map(|joint| even(&joint.position)).collect(),
            command: log.joints.iter().map(|joint| even(&joint.command)).collect(),
        }
    })
    .collect()
}

/// Where the points of an even clock lie between samples.
struct Clock {
    /// Sample before the point, and the share of the way to the next.
    points: Vec<(usize, f64)>,
}

impl Clock {
    fn of(time_s: &[f64], period_s: f64) -> Self {
        let span_s = time_s[time_s.len() - 1] - time_s[0];
        let count = (span_s / period_s + 1e-6) as usize + 1;
        let mut row = 0;
        let points = (0..count).map(|point| {
            let time = time_s[0] + point as f64 * period_s;
            while row + 2 < time_s.len() && time_s[row + 1] <= time {
                row += 1;
            }
            let share = (time - time_s[row]) / (time_s[row + 1] - time_s[row]);
            (row, share.clamp(0.0, 1.0))
        });
        Self { points: points.collect() }
    }

    fn sample(&self, values: &[f64]) -> Vec<f64> {
        let between =
            |&(row, share): &(usize, f64)| values[row] + share * (values[row + 1] - values[row]);
        self.points.iter().map(between).collect()
    }
}
