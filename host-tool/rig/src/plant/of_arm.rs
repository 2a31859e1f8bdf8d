//! The plant that a file of an arm describes.

use files::arm_file::DriveKind;
use files::{ArmFile, ArmJoint, FileError};
use model::Friction;

use super::body::Body;
use super::gear::Gear;
use super::plant::Plant;

/// Why an arm's file describes no plant.
#[derive(Debug, thiserror::Error)]
pub enum PlantError {
    /// A link is not known.
    #[error(transparent)]
    File(Box<FileError>),
    /// A drive whose command says nothing of torque.
    #[error("joint {joint} is driven by a position servo: its command is a goal, no voltage")]
    PositionServo {
        /// The joint, from 1.
        joint: usize,
    },
    /// What a drive makes of its command is not known.
    #[error("the drive of joint {joint} has no torque constant")]
    NoTorqueConstant {
        /// The joint, from 1.
        joint: usize,
    },
}

impl From<FileError> for PlantError {
    fn from(error: FileError) -> Self {
        Self::File(Box::new(error))
    }
}

/// Friction of a joint of which nothing is known, in parts of a command's unit: as good as none.
const NO_FRICTION_V: f64 = 1e-6;
/// Bend of bristles that no file gives, and a Stribeck velocity [rad, rad/s; m, m/s].
const BENT_RAD: f64 = 1e-3;
const STRIBECK_RAD_PER_S: f64 = 0.01;

impl Plant {
    /// The plant of an arm; friction that the file does not give is none.
    ///
    /// # Errors
    /// A link or a torque constant is not known, or a drive is a position servo.
    pub fn of_arm(arm: &ArmFile) -> Result<Self, PlantError> {
        Ok(Self {
            torque_constant_nm_per_v: torque_constants(arm)?,
            body: Body::of_chain(arm.chain()?),
            friction: arm.joints.iter().map(friction).collect(),
            gears: arm.joints.iter().map(Gear::of).collect(),
        })
    }
}

/// Torque by command of every joint [Nm or N by V or A; 1 where the command is the torque].
///
/// # Errors
/// A position servo, or a drive without a torque constant.
pub fn torque_constants(arm: &ArmFile) -> Result<Vec<f64>, PlantError> {
    let of_joint = |(joint, described): (usize, &ArmJoint)| {
        let drive = described.drive.clone().unwrap_or_default();
        match drive.kind {
            DriveKind::PositionServo => Err(PlantError::PositionServo { joint }),
            DriveKind::Torque => Ok(1.0),
            DriveKind::Voltage | DriveKind::Current => {
                drive.torque_constant.ok_or(PlantError::NoTorqueConstant { joint })
            }
        }
    };
    (1..).zip(&arm.joints).map(of_joint).collect()
}

fn friction(joint: &ArmJoint) -> Friction<f64> {
    let given = joint.friction.unwrap_or_default();
    let alpha0_v = given.alpha0.unwrap_or(0.0).max(NO_FRICTION_V);
    let alpha1_v = given.alpha1.unwrap_or(0.0);
    let level_v = alpha0_v.max(alpha0_v + alpha1_v);
    Friction {
        alpha0_v,
        alpha1_v,
        stribeck_velocity_rad_per_s: given.stribeck_velocity.unwrap_or(STRIBECK_RAD_PER_S),
        alpha2_v_s_per_rad: given.alpha2.unwrap_or(0.0),
        sigma0_v_per_rad: given.sigma0.unwrap_or(level_v / BENT_RAD),
        sigma1_v_s_per_rad: given.sigma1.unwrap_or(0.0),
    }
}
