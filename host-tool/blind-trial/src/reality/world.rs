//! All that a case's robot does beyond its causes.

use rand_distr::{Distribution, StandardNormal};
use serde::Serialize;

use super::bus::Bus;
use super::coloured_noise::ColouredNoise;
use super::friction::JointFriction;
use crate::cause::TrueCause;
use crate::rng::Rng;
use model::Robot;
use rig::effects::{Effect, EffectError};
use simulation::{FrictionLaw, SimulatedRobot};

/// The finest encoder that the board takes.
const FINEST_BITS: u32 = 24;

/// How far the model as given is from the robot.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ModelError {
    /// Relative standard deviation of base and friction parameters.
    pub parameters: f64,
    /// Of the torque constants.
    pub torque_constants: f64,
    /// Of the lengths.
    pub lengths: f64,
}

/// What a reality does that the diagnosis was not made for.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reality {
    /// The friction of each joint.
    pub friction: [JointFriction; 3],
    /// Small effects everywhere, of which none is a cause to be found.
    pub clutter: Vec<TrueCause>,
    /// Noise of the amplifiers beside the white one.
    pub coloured_noise: ColouredNoise,
    /// Encoder, clock and bus.
    pub bus: Bus,
    /// How far off the model is.
    pub model_error: ModelError,
}

impl Reality {
    /// LuGre friction, nothing small, the paper's rig, a model 2 % off.
    pub fn plain() -> Self {
        Self {
            friction: [JointFriction::LUGRE; 3],
            clutter: Vec::new(),
            coloured_noise: ColouredNoise { rms_v: 0.0, correlation_time_s: 0.01 },
            bus: Bus::faultless(),
            model_error: ModelError { parameters: 0.02, torque_constants: 0.0, lengths: 0.0 },
        }
    }

    /// The same with LuGre friction and nothing small.
    pub fn bare(&self) -> Self {
        Self { friction: [JointFriction::LUGRE; 3], clutter: Vec::new(), ..self.clone() }
    }

    /// The same without noise, encoder steps and jitter.
    pub fn quiet(&self) -> Self {
        let coloured_noise = ColouredNoise { rms_v: 0.0, ..self.coloured_noise };
        let bus = Bus { encoder_bits: FINEST_BITS, sampling_jitter_s: 0.0, ..self.bus };
        Self { coloured_noise, bus, ..self.clone() }
    }

    /// What it adds to a robot's effects; `seed` is the noise's.
    ///
    /// # Errors
    /// Values that an effect does not take.
    pub fn effects(&self, seed: u64) -> Result<Vec<Box<dyn Effect>>, EffectError> {
        let mut effects = Vec::new();
        for cause in &self.clutter {
            effects.push(cause.build()?);
        }
        effects.extend(self.coloured_noise.effect(seed));
        Ok(effects)
    }

    /// The laws of friction of a robot, cold and at rest.
    pub fn friction_laws(&self, robot: &Robot<f64>) -> [Box<dyn FrictionLaw>; 3] {
        [0, 1, 2].map(|i| self.friction[i].build(&robot.friction[i]))
    }

    /// Encoders that are read a little early or late.
    pub fn sampler(&self, mut rng: Rng) -> impl FnMut(&SimulatedRobot) -> [f64; 3] + use<> {
        let jitter_s = self.bus.sampling_jitter_s;
        move |robot| {
            if jitter_s <= 0.0 {
                return robot.reading_rad();
            }
            let deviate: f64 = StandardNormal.sample(rng.generator());
            let (reading, qd) = (robot.reading_rad(), robot.qd_rad_per_s());
            [0, 1, 2].map(|i| reading[i] + jitter_s * deviate * qd[i])
        }
    }
}
