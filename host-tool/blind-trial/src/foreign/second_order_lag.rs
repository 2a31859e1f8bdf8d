//! A current loop that swings before it settles.

use super::definition::Definition;
use rig::effects::{Effect, JointState};

pub(super) const DEFINITION: Definition = Definition {
    name: "second_order_lag",
    words: "the current follows the command as a second-order lag: T^2 u'' + 2 D T u' + u = command",
    resembles: &["actuator_lag", "delay"],
    equivalent: &["actuator_lag", "delay"],
    grows: true,
    parameters: &["time_constant_s", "damping_ratio"],
    draw: |_, random| vec![random.log_uniform(5e-4, 4e-3), random.uniform(0.4, 1.0)],
    build: |joint, values| {
        Box::new(SecondOrderLag {
            joint,
            frequency_per_s: 1.0 / values[0],
            damping_ratio: values[1],
            step_s: 0.0,
            output_v: 0.0,
            slope_v_per_s: 0.0,
        })
    },
};

#[derive(Clone, Debug)]
struct SecondOrderLag {
    joint: usize,
    frequency_per_s: f64,
    damping_ratio: f64,
    step_s: f64,
    output_v: f64,
    slope_v_per_s: f64,
}

impl Effect for SecondOrderLag {
    fn set_step(&mut self, step_s: f64) {
        self.step_s = step_s;
    }

    /// Implicit Euler on the slope, which is stable for every time constant.
    fn change_command(&mut self, _: &JointState, command_v: &mut [f64]) {
        let (w, h) = (self.frequency_per_s, self.step_s);
        let pull = w * w * (command_v[self.joint] - self.output_v);
        let whole = 1.0 + 2.0 * self.damping_ratio * w * h + w * w * h * h;
        self.slope_v_per_s = (self.slope_v_per_s + h * pull) / whole;
        self.output_v += h * self.slope_v_per_s;
        command_v[self.joint] = self.output_v;
    }
}
