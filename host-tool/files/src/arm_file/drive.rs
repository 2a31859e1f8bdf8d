//! What a file says of a joint's drive, encoder and friction.

use std::collections::BTreeMap;

/// What a command of the log is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DriveKind {
    /// A voltage [V].
    #[default]
    Voltage,
    /// The torque itself [Nm; N].
    Torque,
    /// A current [A].
    Current,
    /// A goal for the position [rad; m]; the drive makes a voltage of it.
    PositionServo,
}

/// `[joint.drive]`; absent values are unknown.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// What the command is.
    pub kind: DriveKind,
    /// Torque at the joint by voltage or current [Nm/V; Nm/A; N/V; N/A]; 1 of a torque drive.
    pub torque_constant: Option<f64>,
    /// Motor turns per turn of the joint, or per metre times 2 pi; may be negative.
    pub gear_ratio: f64,
    /// Voltage of a position servo by the distance to its goal [V/rad; V/m].
    pub stiffness: Option<f64>,
    /// Voltage of a position servo against its velocity [V s/rad; V s/m].
    pub damping: Option<f64>,
    /// Largest command either way, of a position servo its largest voltage [V; A; Nm; N].
    pub limit: Option<f64>,
}

impl Default for Drive {
    fn default() -> Self {
        Self {
            kind: DriveKind::default(),
            torque_constant: None,
            gear_ratio: 1.0,
            stiffness: None,
            damping: None,
            limit: None,
        }
    }
}

/// Which shaft an encoder is on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum EncoderSide {
    /// The joint's.
    #[default]
    Joint,
    /// The motor's, before the gear.
    Motor,
}

/// `[joint.encoder]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Encoder {
    /// Counts per turn of the shaft; per metre of a prismatic joint's own encoder.
    pub counts: f64,
    /// Which shaft that is.
    pub side: EncoderSide,
}

impl Encoder {
    /// One count as a position of the joint [rad; m], from the gear ratio and the kind of joint;
    /// negative where the motor turns against the joint.
    pub fn step(&self, gear_ratio: f64, is_prismatic: bool) -> f64 {
        let turn = std::f64::consts::TAU;
        match (self.side, is_prismatic) {
            (EncoderSide::Joint, true) => 1.0 / self.counts,
            (EncoderSide::Joint, false) => turn / self.counts,
            (EncoderSide::Motor, _) => turn / (self.counts * gear_ratio),
        }
    }
}

/// `[joint.friction]`, eq. (9)-(10), in the unit of the command; absent values are unknown.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ArmFriction {
    /// Coulomb level.
    pub alpha0: Option<f64>,
    /// Static level above the Coulomb level.
    pub alpha1: Option<f64>,
    /// Stribeck velocity [rad/s; m/s].
    pub stribeck_velocity: Option<f64>,
    /// Viscous coefficient, by rad/s or m/s.
    pub alpha2: Option<f64>,
    /// Pre-sliding stiffness, by rad or m.
    pub sigma0: Option<f64>,
    /// Pre-sliding damping, by rad/s or m/s.
    pub sigma1: Option<f64>,
}

impl ArmFriction {
    /// Height and width of the Stribeck peak of eq. (10), where both are told and there is one [unit of the command; rad/s
    /// or m/s].
    pub fn peak(&self) -> Option<[f64; 2]> {
        Some([self.alpha1.filter(|height| *height != 0.0)?, self.stribeck_velocity?])
    }
}

/// Standard errors by the names of the values, one entry per component.
pub type StandardErrors = BTreeMap<String, Vec<f64>>;
