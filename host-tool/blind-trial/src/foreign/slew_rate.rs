//! An amplifier that is too slow for large changes.

use super::definition::Definition;
use rig::effects::{Effect, JointState};

pub(super) const DEFINITION: Definition = Definition {
    name: "slew_rate",
    words: "the amplifier follows the command no faster than R: |du'/dt| <= R",
    resembles: &["actuator_lag", "delay", "saturation"],
    equivalent: &[],
    grows: false,
    parameters: &["rate_V_per_s"],
    draw: |_, random| vec![random.log_uniform(30.0, 400.0)],
    build: |joint, values| {
        Box::new(SlewRate { joint, rate_v_per_s: values[0], step_s: 0.0, output_v: 0.0 })
    },
};

#[derive(Clone, Debug)]
struct SlewRate {
    joint: usize,
    rate_v_per_s: f64,
    step_s: f64,
    output_v: f64,
}

impl Effect for SlewRate {
    fn set_step(&mut self, step_s: f64) {
        self.step_s = step_s;
    }

    /// The mean over the step is taken as its end: a step is a tenth of a millisecond.
    fn change_command(&mut self, _: &JointState, command_v: &mut [f64]) {
        let most_v = self.rate_v_per_s * self.step_s;
        self.output_v += (command_v[self.joint] - self.output_v).clamp(-most_v, most_v);
        command_v[self.joint] = self.output_v;
    }
}
