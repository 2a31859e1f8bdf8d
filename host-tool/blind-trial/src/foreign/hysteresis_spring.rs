//! Cables that rub inside: a spring that slips.

use std::f64::consts::PI;

use super::definition::Definition;
use rig::effects::{Effect, JointState};

pub(super) const DEFINITION: Definition = Definition {
    name: "hysteresis_spring",
    words: "cables pull back but slip, after Bouc and Wen: u - k z, z' = v - |v| z / z0",
    resembles: &["cable_spring", "position_friction", "asymmetric_friction"],
    equivalent: &[],
    grows: true,
    parameters: &["stiffness_V_per_rad", "slip_rad"],
    draw: |_, random| {
        let (slip_rad, level_v) =
            (random.log_uniform(0.1, 0.25 * PI), random.log_uniform(0.05, 0.3));
        vec![level_v / slip_rad, slip_rad]
    },
    build: |joint, values| {
        Box::new(HysteresisSpring {
            joint,
            stiffness_v_per_rad: values[0],
            slip_rad: values[1],
            step_s: 0.0,
            stretch_rad: 0.0,
        })
    },
};

#[derive(Clone, Debug)]
struct HysteresisSpring {
    joint: usize,
    stiffness_v_per_rad: f64,
    slip_rad: f64,
    step_s: f64,
    stretch_rad: f64,
}

impl Effect for HysteresisSpring {
    fn set_step(&mut self, step_s: f64) {
        self.step_s = step_s;
    }

    /// The exact solution for a velocity that is constant over the step.
    fn change_command(&mut self, state: &JointState, command_v: &mut [f64]) {
        let velocity = state.qd_rad_per_s[self.joint];
        let end_rad = self.slip_rad.copysign(velocity);
        let share = -(-velocity.abs() * self.step_s / self.slip_rad).exp_m1();
        self.stretch_rad += share * (end_rad - self.stretch_rad);
        command_v[self.joint] -= self.stiffness_v_per_rad * self.stretch_rad;
    }
}
