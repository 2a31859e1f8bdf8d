//! The reference: a motion and an injected voltage for each joint.
//!
//! Both are functions of the tick alone, so a run can be repeated exactly, and the host
//! computes the same reference without the board.

mod constant_velocity;
mod fourier;
mod injection;
mod motion;
mod noise;
mod setpoint;
mod sine;
mod time;
mod wave;

pub use constant_velocity::{ConstantVelocity, MAX_SPEEDS};
pub use fourier::{FourierSeries, TERMS};
pub use injection::{FrictionExcitation, Injection, InjectionSource};
pub use motion::Motion;
pub use noise::{Noise, NoiseSource};
pub use setpoint::{BRAKING_S, Setpoint, braking_distance_rad, braking_time_s};
pub use sine::Sine;
pub use time::Time;
pub use wave::FadeIn;

use serde::{Deserialize, Serialize};

/// The reference of all joints.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reference {
    /// Motion of each joint.
    pub motion: [Motion; 3],
    /// Voltage added to each joint's command.
    pub injection: [Injection; 3],
    /// When it ends [s]; after that the joints brake and hold.
    pub duration_s: f32,
}

impl Reference {
    /// All joints hold these angles without end.
    pub fn hold(angles_rad: [f32; 3]) -> Self {
        Self {
            motion: angles_rad.map(|angle_rad| Motion::Hold { angle_rad }),
            injection: [Injection::None; 3],
            duration_s: f32::MAX,
        }
    }
}
