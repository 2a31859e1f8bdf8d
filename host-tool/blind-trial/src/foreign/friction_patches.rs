//! Places of the turn where a joint rubs more.

use std::f64::consts::{PI, TAU};

use model::friction::FrictionScale;

use super::definition::Definition;
use rig::effects::{Effect, JointState};

pub(super) const DEFINITION: Definition = Definition {
    name: "friction_patches",
    words: "friction is higher at one or two places of the turn: \
            level times 1 + a exp(-(q - q0)^2 / 2 w^2)",
    resembles: &["position_friction", "load_friction"],
    equivalent: &["position_friction"],
    grows: true,
    parameters: &["relative_change", "angle_rad", "width_rad", "second", "second_angle_rad"],
    draw: |joint, random| {
        let middle_rad = [0.0, -0.5 * PI, 0.0][joint];
        let [first_rad, second_rad] = [(); 2].map(|()| middle_rad + random.uniform(-1.5, 1.5));
        let second = if random.unit() < 0.5 { 0.0 } else { random.uniform(0.3, 1.0) };
        let change = random.log_uniform(0.15, 0.8);
        vec![change, first_rad, random.uniform(0.15, 0.6), second, second_rad]
    },
    build: |joint, values| {
        Box::new(FrictionPatches {
            joint,
            changes: [values[0], values[0] * values[3]],
            angles_rad: [values[1], values[4]],
            width_rad: values[2],
        })
    },
};

#[derive(Clone, Debug)]
struct FrictionPatches {
    joint: usize,
    changes: [f64; 2],
    angles_rad: [f64; 2],
    width_rad: f64,
}

impl Effect for FrictionPatches {
    fn change_friction(&self, state: &JointState, scale: &mut [FrictionScale<f64>]) {
        let bump = |(change, angle): (f64, f64)| {
            let past_rad = (state.q_rad[self.joint] - angle + PI).rem_euclid(TAU) - PI;
            change * (-0.5 * (past_rad / self.width_rad).powi(2)).exp()
        };
        let more: f64 = self.changes.into_iter().zip(self.angles_rad).map(bump).sum();
        scale[self.joint].level *= 1.0 + more;
    }
}
