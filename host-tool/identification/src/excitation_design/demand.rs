//! What a motion asks of joints and amplifiers.

use model::{Posture, Robot};

use super::series::State;
use super::settings::Limits;

/// Peaks of a motion, per joint.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Demand {
    /// Largest velocity [rad/s].
    pub velocity_rad_per_s: [f64; 3],
    /// Largest command, by inverse dynamics and friction, eq. (8) [V].
    pub command_v: [f64; 3],
}

impl Demand {
    /// The peaks over all states.
    pub fn of(robot: &Robot<f64>, states: impl Iterator<Item = State>) -> Self {
        states.fold(Self::default(), |peaks, state| {
            let command_v = command(robot, &state);
            let larger =
                |peak: [f64; 3], now: [f64; 3]| [0, 1, 2].map(|i| peak[i].max(now[i].abs()));
            Self {
                velocity_rad_per_s: larger(peaks.velocity_rad_per_s, state.qd_rad_per_s),
                command_v: larger(peaks.command_v, command_v),
            }
        })
    }

    /// Peak velocities as shares of what the limits let a design use.
    pub fn velocity_share(&self, limits: &Limits) -> [f64; 3] {
        let usable = limits.usable_velocity_rad_per_s();
        [0, 1, 2].map(|i| self.velocity_rad_per_s[i] / usable[i])
    }

    /// Peak voltages as shares of what the limits let a design use.
    pub fn command_share(&self, limits: &Limits) -> [f64; 3] {
        self.command_v.map(|peak_v| peak_v / limits.usable_command_v())
    }

    /// Whether all limits are kept, to rounding.
    pub fn keeps(&self, limits: &Limits) -> bool {
        let shares = [self.velocity_share(limits), self.command_share(limits)];
        shares.as_flattened().iter().all(|&share| share <= 1.0 + 1e-6)
    }
}

/// The command that a state needs [V], friction in steady sliding (10).
fn command(robot: &Robot<f64>, state: &State) -> [f64; 3] {
    let torque_nm = Posture::new(state.q_rad[1], state.q_rad[2]).inverse_dynamics(
        &robot.base,
        &robot.geometry,
        &state.qd_rad_per_s,
        &state.qdd_rad_per_s2,
    );
    let rigid_v = robot.torque_to_voltage(&torque_nm);
    [0, 1, 2].map(|i| rigid_v[i] + robot.friction[i].sliding(state.qd_rad_per_s[i]))
}
