//! What a joint did in the logs, by which effects are sized.

use crate::base::Base;
use crate::judged::Judged;

/// A joint that rubs less than this is sized as if it rubbed so much [V].
const LEAST_FRICTION_V: f64 = 0.02;

/// What a joint did in the logs.
#[derive(Clone, Copy, Debug)]
pub struct Typical {
    /// Largest voltage that its law asks for, distance to the goal times stiffness [V].
    pub volts: f64,
    /// Mean position [rad].
    pub position: f64,
    /// How far it went [rad].
    pub range: f64,
    /// Lowest and highest goal [rad].
    pub goals: [f64; 2],
    /// Largest share of gravity in its voltage [V].
    pub gravity_volts: f64,
    /// Voltage of its friction [V].
    pub friction_volts: f64,
}

impl Typical {
    /// Of a joint (from 0).
    pub fn of(base: &Base, logs: &[&Judged], joint: usize) -> Self {
        let tracks = || logs.iter().map(|log| &log.record.joints[joint]);
        let servo = &base.fitted.servo;
        let pairs = tracks().flat_map(|track| track.goal.iter().zip(&track.position));
        let distance = pairs.map(|(g, q)| (g - q).abs()).fold(0.0, f64::max);
        let [low, high] = ends(tracks().flat_map(|track| track.position.iter().copied()));
        let loads = logs.iter().flat_map(|log| &log.along[joint]);
        let load = loads.map(|row| (row.gravity + row.constant).abs()).fold(0.0, f64::max);
        Self {
            volts: servo.stiffness * distance,
            position: 0.5 * (low + high),
            range: high - low,
            goals: ends(tracks().flat_map(|track| track.goal.iter().copied())),
            gravity_volts: load / servo.torque_constant,
            friction_volts: servo.coulomb.max(LEAST_FRICTION_V),
        }
    }

    /// Whether gravity asks more of the joint than friction does.
    pub fn bears_load(&self) -> bool {
        self.gravity_volts > self.friction_volts
    }
}

fn ends(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
}
