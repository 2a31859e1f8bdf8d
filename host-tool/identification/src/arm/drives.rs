//! What a command is worth at the joint.

use files::ArmFile;
use files::arm_file::DriveKind;

use super::error::ArmError;

/// Torque by command of every joint [Nm or N by V, A; 1 where the command is the torque].
///
/// # Errors
/// A position servo, or a drive without a torque constant.
pub fn torque_constants(arm: &ArmFile) -> Result<Vec<f64>, ArmError> {
    (1..)
        .zip(&arm.joints)
        .map(|(joint, described)| {
            let drive = described.drive.clone().unwrap_or_default();
            match drive.kind {
                DriveKind::PositionServo => Err(ArmError::PositionServo { joint }),
                DriveKind::Torque => Ok(1.0),
                DriveKind::Voltage | DriveKind::Current => {
                    drive.torque_constant.ok_or(ArmError::NoTorqueConstant { joint })
                }
            }
        })
        .collect()
}
