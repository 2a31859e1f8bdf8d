//! The motion along which the rigid body is computed: of each joint, from a row to the next.
//!
//! Of measured positions a parabola over 0.2 s gives the acceleration, and misses most of what a step of
//! a goal makes, which is over in 50 ms. A model of the arm knows it. So once joints are fitted, the
//! motion is that of the simulated arm, and the parabola goes through what the simulation leaves.

use crate::joint::ServoJoint;
use crate::motion::derivatives;
use crate::record::Record;
use crate::replay::Replay;
use crate::settings::Settings;

/// A joint between each row and the next one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Moves {
    /// How far the joint stands from where the encoder says [rad].
    pub turn: f64,
    /// Positions as the encoder says [rad; m].
    pub position: Vec<f64>,
    /// Velocities [rad/s; m/s].
    pub velocity: Vec<f64>,
    /// Accelerations [rad/s^2; m/s^2].
    pub acceleration: Vec<f64>,
}

impl Moves {
    /// Whether all of it is a number.
    pub fn is_finite(&self) -> bool {
        let all = [&self.position, &self.velocity, &self.acceleration];
        all.into_iter().flatten().all(|value| value.is_finite())
    }
}

/// All joints as measured and smoothed.
pub fn measured(record: &Record) -> Vec<Moves> {
    let of = |track: &crate::record::Track| Moves {
        turn: 0.0,
        position: means(&track.position),
        velocity: means(&track.velocity),
        acceleration: means(&track.acceleration),
    };
    record.joints.iter().map(of).collect()
}

/// All joints as simulated together, with what that leaves of the measured positions, smoothed.
pub fn simulated(
    record: &Record,
    servos: &[ServoJoint],
    found: &[Replay],
    settings: &Settings,
) -> Vec<Moves> {
    let time = &record.time_s;
    let of = |joint: usize| {
        let (servo, found) = (&servos[joint], &found[joint]);
        let read = found.read(time, servo.read_after_s, servo.gap);
        let pairs = record.joints[joint].position.iter().zip(&read);
        let left: Vec<f64> = pairs.map(|(measured, found)| measured - found).collect();
        let (slope, bend) = derivatives(time, &left, settings.half_window_s);
        Moves {
            turn: 0.0,
            position: sums(means(&found.q), means(&left)),
            velocity: sums(rates(time, &found.q), means(&slope)),
            acceleration: sums(rates(time, &found.v), means(&bend)),
        }
    };
    (0..servos.len()).map(of).collect()
}

/// Means of each value and the next; the last one by itself.
fn means(values: &[f64]) -> Vec<f64> {
    let next = values.iter().skip(1).chain(values.last());
    values.iter().zip(next).map(|(here, next)| 0.5 * (here + next)).collect()
}

/// Differences of each value to the next over their distance in time; none from the last one on.
fn rates(time_s: &[f64], values: &[f64]) -> Vec<f64> {
    let rate = |row: usize| (values[row + 1] - values[row]) / (time_s[row + 1] - time_s[row]);
    (0..values.len()).map(|row| if row + 1 < values.len() { rate(row) } else { 0.0 }).collect()
}

fn sums(one: Vec<f64>, other: Vec<f64>) -> Vec<f64> {
    one.into_iter().zip(other).map(|(one, other)| one + other).collect()
}
