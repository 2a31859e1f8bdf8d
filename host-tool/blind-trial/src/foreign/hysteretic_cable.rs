//! A cable that pulls back like a spring and rubs inside while it bends.

use std::f64::consts::PI;

use super::definition::Definition;
use rig::effects::{Effect, JointState};

pub(super) const DEFINITION: Definition = Definition {
    name: "hysteretic_cable",
    words: "a cable's spring with a part that slips: u - k (q - q0) - h z / z0, z' = v - |v| z / z0",
    resembles: &["cable_spring", "position_friction"],
    equivalent: &["cable_spring"],
    grows: true,
    parameters: &["stiffness_V_per_rad", "rest_rad", "relative_slip", "slip_rad"],
    draw: |joint, random| {
        let rest_rad = [0.0, -0.5 * PI, 0.0][joint] + random.uniform(-1.0, 1.0);
        let stiffness = random.log_uniform(0.05, 0.5);
        vec![stiffness, rest_rad, random.uniform(0.1, 0.5), random.log_uniform(0.05, 0.5)]
    },
    build: |joint, values| {
        Box::new(HystereticCable {
            joint,
            stiffness_v_per_rad: values[0],
            rest_rad: values[1],
            slip_v: values[0] * values[2],
            slip_rad: values[3],
            step_s: 0.0,
            stretch: 0.0,
        })
    },
};

#[derive(Clone, Debug)]
struct HystereticCable {
    joint: usize,
    stiffness_v_per_rad: f64,
    rest_rad: f64,
    slip_v: f64,
    slip_rad: f64,
    step_s: f64,
    /// The slipping part, -1 to 1.
    stretch: f64,
}

impl Effect for HystereticCable {
    fn set_step(&mut self, step_s: f64) {
        self.step_s = step_s;
    }

    /// The exact solution for a velocity that is constant over the step.
    fn change_command(&mut self, state: &JointState, command_v: &mut [f64]) {
        let velocity = state.qd_rad_per_s[self.joint];
        let share = -(-velocity.abs() * self.step_s / self.slip_rad).exp_m1();
        self.stretch += share * (1.0_f64.copysign(velocity) - self.stretch);
        let bent_rad = state.q_rad[self.joint] - self.rest_rad;
        command_v[self.joint] -= self.stiffness_v_per_rad * bent_rad + self.slip_v * self.stretch;
    }
}
