//! How often shafts turn per turn of their joint.

use files::ArmJoint;
use files::arm_file::EncoderSide;

/// Turns of a joint's shafts per turn of the joint, or per 2 pi metres of a sliding one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gear {
    /// Those of the motor; negative where it turns against the joint.
    pub motor: f64,
    /// Those of the shaft that the encoder is on.
    pub encoder: f64,
}

impl Gear {
    /// A motor that is the joint.
    pub const DIRECT: Self = Self { motor: 1.0, encoder: 1.0 };

    /// That of a joint as its file says.
    pub fn of(joint: &ArmJoint) -> Self {
        let motor = joint.drive.as_ref().map_or(1.0, |drive| drive.gear_ratio);
        let on_motor = joint.encoder.is_some_and(|encoder| encoder.side == EncoderSide::Motor);
        Self { motor, encoder: if on_motor { motor } else { 1.0 } }
    }
}
