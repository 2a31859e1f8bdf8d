//! A rubber buffer that hardens.

use std::f64::consts::PI;

use super::definition::Definition;
use rig::effects::{Effect, JointState};

pub(super) const DEFINITION: Definition = Definition {
    name: "hardening_spring",
    words: "a rubber buffer hardens as it is pressed: u - k x^3, x = q - q0 beyond a play",
    resembles: &["cable_spring", "cogging"],
    equivalent: &[],
    grows: true,
    parameters: &["stiffness_V_per_rad3", "rest_rad", "play_rad"],
    draw: |joint, random| {
        let rest_rad = [0.0, -0.5 * PI, 0.0][joint] + random.uniform(-0.5, 0.5);
        vec![random.log_uniform(0.01, 0.1), rest_rad, random.uniform(0.0, 1.0)]
    },
    build: |joint, values| {
        let (stiffness_v_per_rad3, rest_rad, play_rad) = (values[0], values[1], values[2]);
        Box::new(HardeningSpring { joint, stiffness_v_per_rad3, rest_rad, play_rad })
    },
};

/// The buffer slips beyond this [V].
const HIGHEST_V: f64 = 1.5;

#[derive(Clone, Debug)]
struct HardeningSpring {
    joint: usize,
    stiffness_v_per_rad3: f64,
    rest_rad: f64,
    play_rad: f64,
}

impl Effect for HardeningSpring {
    fn add_voltage(&self, state: &JointState, voltage_v: &mut [f64]) {
        let away_rad = state.q_rad[self.joint] - self.rest_rad;
        let pressed_rad = (away_rad.abs() - self.play_rad).max(0.0);
        let size_v = (self.stiffness_v_per_rad3 * pressed_rad.powi(3)).min(HIGHEST_V);
        voltage_v[self.joint] -= size_v.copysign(away_rad);
    }
}
