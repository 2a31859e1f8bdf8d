//! A motor that weakens as it warms.

use super::definition::Definition;
use rig::effects::{Effect, JointState};

pub(super) const DEFINITION: Definition = Definition {
    name: "fading_torque",
    words: "the magnets weaken as they warm: (1 - e (1 - exp(-t/T))) u",
    resembles: &["friction_drift", "torque_constant"],
    equivalent: &[],
    grows: true,
    parameters: &["relative_loss", "time_constant_s"],
    draw: |_, random| vec![random.log_uniform(0.05, 0.3), random.uniform(2.0, 10.0)],
    build: |joint, values| {
        Box::new(FadingTorque { joint, relative_loss: values[0], time_constant_s: values[1] })
    },
};

#[derive(Clone, Debug)]
struct FadingTorque {
    joint: usize,
    relative_loss: f64,
    time_constant_s: f64,
}

impl Effect for FadingTorque {
    fn change_command(&mut self, state: &JointState, command_v: &mut [f64]) {
        let warmed = -(-state.time_s / self.time_constant_s).exp_m1();
        command_v[self.joint] *= 1.0 - self.relative_loss * warmed;
    }
}
