//! The compensations in a parameter block.

use heapless::Vec;
use model::effects::Tilt;
use serde::{Deserialize, Serialize};

use super::tables::{MAX_TABLES, Table};
use crate::Angle;

/// Room for effects compensated by feedforward, per joint.
pub const MAX_FEEDFORWARD: usize = 6;
/// Room for input effects that are inverted, per joint.
pub const MAX_INPUT_INVERSES: usize = 4;

/// The compensations of one joint.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Compensations {
    /// Effects compensated by feedforward.
    pub feedforward: Vec<Feedforward, MAX_FEEDFORWARD>,
    /// Effects between command and motor, in the order in which they act; the inverses are
    /// applied in the opposite order.
    pub input_inverses: Vec<InputInverse, MAX_INPUT_INVERSES>,
    /// Curves that are compensated by feedforward, as far as the reference tells where on them
    /// the joint is.
    pub tables: Vec<Table, MAX_TABLES>,
}

/// An effect compensated by feedforward.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Feedforward {
    /// Cogging: A sin(n q + phi) added to the motor's voltage.
    Cogging {
        /// A [V].
        amplitude_v: f32,
        /// sin(n q + phi)
        wave: AngularHarmonic,
    },
    /// A cable: -k (q - q0) added to the motor's voltage.
    CableSpring {
        /// k [V/rad].
        stiffness_v_per_rad: f32,
        /// q0 [rad], counted in turns as the reference is.
        rest_rad: f32,
    },
    /// Drag: -b qd |qd| added to the motor's voltage.
    QuadraticDrag {
        /// b [V s^2/rad^2].
        coefficient_v_s2_per_rad2: f32,
    },
    /// Friction level times 1 + a sin(n q + phi).
    PositionFriction {
        /// a
        relative_amplitude: f32,
        /// sin(n q + phi)
        wave: AngularHarmonic,
    },
    /// Friction times 1 + e forwards and 1 - e backwards.
    AsymmetricFriction {
        /// e
        relative_asymmetry: f32,
    },
}

/// An effect between command and motor, whose inverse is applied to the command.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum InputInverse {
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
        wave: AngularHarmonic,
    },
    /// u plus a constant.
    DacOffset {
        /// The constant [V].
        offset_v: f32,
    },
    /// The amplifier passes nothing below a voltage, and the excess above it.
    DeadZone {
        /// That voltage [V].
        half_width_v: f32,
    },
}

/// sin(n q + phi) in the board's angles, which wrap at the turn: n is an integer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct AngularHarmonic {
    /// Waves per turn, n.
    pub order: u16,
    /// Phase phi.
    pub phase: Angle,
}

/// Loads on the arm that the model of a level, free arm lacks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ExternalLoad {
    /// Tilt of the base.
    pub tilt: Tilt<f32>,
    /// A force on the tip, in the base frame [N].
    pub tip_force_n: [f32; 3],
}
