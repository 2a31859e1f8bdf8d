//! What a joint does beyond the model, and how the command makes up for it.
//!
//! ```text
//! u = f1^-1( ... fn^-1( w - a ) )
//! ```
//!
//! w is the voltage that the control law wants at the motor, a what the motor finds added
//! to its own (cogging, cables, drag), f1 to fn what happens to the command on its way
//! there (offset, dead zone, ripple, torque constant), in the order of the list.
//! Friction that varies is fed forward as it varies. All of it is taken at the wanted
//! motion, as the model is. The mathematics is that of [`model::effects`].

mod apply;
mod check;
pub mod limits;

pub(crate) use apply::Moving;

use heapless::Vec;
use model::effects::Tilt;
use serde::{Deserialize, Serialize};

use crate::Angle;

/// The most effects of one joint that feedforward makes up for.
pub const MOST_FED_FORWARD: usize = 6;
/// The most effects of one joint that its command makes up for.
pub const MOST_UNDONE: usize = 4;

/// What is made up for at one joint.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Compensations {
    /// What feedforward makes up for.
    pub fed_forward: Vec<FedForward, MOST_FED_FORWARD>,
    /// What becomes of the command on its way to the motor, in that order.
    pub undone: Vec<Undone, MOST_UNDONE>,
}

/// An effect that feedforward makes up for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum FedForward {
    /// A sin(n q + phi) on top of the motor's voltage.
    Cogging {
        /// A [V].
        amplitude_v: f32,
        /// sin(n q + phi)
        wave: TurnWave,
    },
    /// -k (q - q0) on top.
    CableSpring {
        /// k [V/rad].
        stiffness_v_per_rad: f32,
        /// q0 [rad], on the turn that the reference's own numbers name.
        rest_rad: f32,
    },
    /// -b qd |qd| on top.
    QuadraticDrag {
        /// b [V s^2/rad^2].
        coefficient_v_s2_per_rad2: f32,
    },
    /// Friction's level times 1 + a sin(n q + phi).
    PositionFriction {
        /// a
        relative_amplitude: f32,
        /// sin(n q + phi)
        wave: TurnWave,
    },
    /// Friction times 1 + e forwards and 1 - e backwards.
    AsymmetricFriction {
        /// e
        relative_asymmetry: f32,
    },
}

/// An effect on the command that the command undoes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Undone {
    /// The motor turns u into (1 + e) k_t u.
    TorqueConstant {
        /// e
        relative_error: f32,
    },
    /// u times 1 + a sin(n q + phi).
    TorqueRipple {
        /// a
        relative_amplitude: f32,
        /// sin(n q + phi)
        wave: TurnWave,
    },
    /// u plus a constant.
    DacOffset {
        /// The constant [V].
        offset_v: f32,
    },
    /// The amplifier swallows the first volts.
    DeadZone {
        /// How many [V].
        half_width_v: f32,
    },
}

/// sin(n q + phi) in the board's angles, which wrap at the turn: n is a whole number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct TurnWave {
    /// Waves per turn, n.
    pub harmonic: u16,
    /// Phase phi.
    pub phase: Angle,
}

/// What acts on the arm from outside.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Outside {
    /// How the base leans.
    pub tilt: Tilt<f32>,
    /// A force on the tip, in the base frame [N].
    pub tip_force_n: [f32; 3],
}
