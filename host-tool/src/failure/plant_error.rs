//! Arms whose files describe no plant.

use rig::plant::PlantError;

use super::Failure;

impl From<PlantError> for Failure {
    fn from(error: PlantError) -> Self {
        let hint = match &error {
            PlantError::File(file) => return Self::from_file(file),
            PlantError::PositionServo { .. } => {
                "give all drives of the arm the kind \"position-servo\", or none of them: goals are judged on motion, \
                 voltages, currents and torques on the command"
            }
            PlantError::NoTorqueConstant { .. } => {
                "give it in [joint.drive], as the data sheet tells it: torque_constant_Nm_per_V, say"
            }
        };
        Self::new(error.to_string(), hint)
    }
}
