//! A spot that the joint must be pushed over.

use std::f64::consts::{PI, TAU};

use super::definition::Definition;
use rig::effects::{Effect, JointState};

pub(super) const DEFINITION: Definition = Definition {
    name: "detent",
    words: "something sticks out at one angle of the turn and pushes away from there: \
            u + A x exp((1 - x^2) / 2), x = (q - q0) / w",
    resembles: &["cogging", "position_friction", "cable_spring"],
    equivalent: &[],
    grows: true,
    parameters: &["amplitude_V", "angle_rad", "width_rad"],
    draw: |joint, random| {
        let angle_rad = [0.0, -0.5 * PI, 0.0][joint] + random.uniform(-1.0, 1.0);
        vec![random.log_uniform(0.1, 0.6), angle_rad, random.uniform(0.04, 0.2)]
    },
    build: |joint, values| {
        let (amplitude_v, angle_rad, width_rad) = (values[0], values[1], values[2]);
        Box::new(Detent { joint, amplitude_v, angle_rad, width_rad })
    },
};

#[derive(Clone, Debug)]
struct Detent {
    joint: usize,
    amplitude_v: f64,
    angle_rad: f64,
    width_rad: f64,
}

impl Effect for Detent {
    fn add_voltage(&self, state: &JointState, voltage_v: &mut [f64]) {
        let past_rad = (state.q_rad[self.joint] - self.angle_rad + PI).rem_euclid(TAU) - PI;
        let x = past_rad / self.width_rad;
        voltage_v[self.joint] += self.amplitude_v * x * (0.5 - 0.5 * x * x).exp();
    }
}
