//! Noise of the amplifiers that remembers itself.

use model::vector::Vector3;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;
use serde::Serialize;

use rig::effects::{Effect, JointState};

/// First-order coloured noise on every joint's voltage.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ColouredNoise {
    /// Its size [V rms]; 0 for none.
    #[serde(rename = "rms_V")]
    pub rms_v: f64,
    /// How long it remembers itself [s].
    pub correlation_time_s: f64,
}

impl ColouredNoise {
    /// The effect that adds it, unless there is none.
    pub fn effect(&self, seed: u64) -> Option<Box<dyn Effect>> {
        (self.rms_v > 0.0).then(|| {
            Box::new(Source {
                noise: *self,
                random: Pcg64Mcg::new(u128::from(seed) << 2 | 3),
                kept: 1.0,
                level_v: [0.0; 3],
            }) as Box<dyn Effect>
        })
    }
}

#[derive(Debug)]
struct Source {
    noise: ColouredNoise,
    random: Pcg64Mcg,
    /// How much of the level a step leaves.
    kept: f64,
    level_v: Vector3<f64>,
}

impl Effect for Source {
    fn set_step(&mut self, step_s: f64) {
        self.kept = (-step_s / self.noise.correlation_time_s).exp();
    }

    fn change_command(&mut self, _: &JointState, command_v: &mut [f64]) {
        let fresh_v = self.noise.rms_v * (1.0 - self.kept * self.kept).sqrt();
        for (level_v, command_v) in self.level_v.iter_mut().zip(command_v) {
            let deviate: f64 = StandardNormal.sample(&mut self.random);
            *level_v = self.kept * *level_v + fresh_v * deviate;
            *command_v += *level_v;
        }
    }
}
