//! Arms whose files describe no plant.

use rig::plant::PlantError;

use super::Failure;

impl From<PlantError> for Failure {
    fn from(error: PlantError) -> Self {
        let hint = match &error {
            PlantError::File(file) => return Self::from_file(file),
            PlantError::PositionServo { .. } => {
                "give drives of one kind: servos alone, or such that take voltages, currents or torques"
            }
            PlantError::NoTorqueConstant { .. } => {
                "give it in [joint.drive], as the data sheet tells it: torque_constant_Nm_per_V, say"
            }
        };
        Self::new(error.to_string(), hint)
    }
}
