//! What to do when logs do not serve an estimate.

use super::Failure;
use identification::arm::ArmError;
use recordings::StepError;

impl From<StepError> for Failure {
    fn from(error: StepError) -> Self {
        let hint = match &error {
            StepError::NoLog { .. } => "list the log in dataset.toml with role \"train\"",
            StepError::Unusable { .. } => "look at the log, and record it again if need be",
            StepError::Numerical { .. } => "look at the logs: the motion may not excite it",
        };
        Self::new(error.to_string(), hint)
    }
}

impl From<ArmError> for Failure {
    fn from(error: ArmError) -> Self {
        Self::new(error.to_string(), error.hint())
    }
}
