//! A disturbance that nothing of the robot explains.

use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;

use super::definition::Definition;
use rig::effects::{Effect, JointState};

pub(super) const DEFINITION: Definition = Definition {
    name: "wandering_torque",
    words: "a disturbance wanders at random and forgets itself in T: an Ornstein-Uhlenbeck \
            process of A rms",
    resembles: &["friction_drift", "dac_offset", "cable_spring"],
    equivalent: &[],
    grows: true,
    parameters: &["rms_V", "correlation_time_s", "seed"],
    draw: |_, random| {
        vec![random.log_uniform(0.03, 0.2), random.log_uniform(0.05, 1.0), f64::from(random.seed())]
    },
    build: |joint, values| {
        Box::new(WanderingTorque {
            joint,
            rms_v: values[0],
            correlation_time_s: values[1],
            random: Pcg64Mcg::new((values[2] as u128) << 1 | 1),
            kept: 1.0,
            level_v: 0.0,
        })
    },
};

#[derive(Clone, Debug)]
struct WanderingTorque {
    joint: usize,
    rms_v: f64,
    correlation_time_s: f64,
    random: Pcg64Mcg,
    /// How much of the level a step leaves.
    kept: f64,
    level_v: f64,
}

impl Effect for WanderingTorque {
    fn set_step(&mut self, step_s: f64) {
        self.kept = (-step_s / self.correlation_time_s).exp();
    }

    fn change_command(&mut self, _: &JointState, command_v: &mut [f64]) {
        let deviate: f64 = StandardNormal.sample(&mut self.random);
        let fresh_v = self.rms_v * (1.0 - self.kept * self.kept).sqrt();
        self.level_v = self.kept * self.level_v + fresh_v * deviate;
        command_v[self.joint] += self.level_v;
    }
}
