//! Why an arm of servos cannot be judged.

use files::FileError;

/// The message names the joint or log, [`ServoError::hint`] the cure.
#[derive(Debug, thiserror::Error)]
pub enum ServoError {
    /// A value that the simulation needs.
    #[error("joint {joint} has no {name}, without which its servo cannot be simulated")]
    Missing {
        /// Its number, from 1.
        joint: usize,
        /// The value's name in the file.
        name: &'static str,
    },
    /// A file that cannot be used.
    #[error(transparent)]
    File(Box<FileError>),
    /// Nothing to fit to.
    #[error("the data set has no log with role \"train\" of 2 s or more")]
    NoLog,
    /// An effect in the model file that servos cannot have.
    #[error("the effect {0} cannot be simulated on position servos, or lacks a parameter")]
    Effect(String),
    /// A parameter of an effect that is out of its bounds.
    #[error("{parameter} of {effect} is not from {lowest} to {highest}")]
    Value {
        /// The effect.
        effect: String,
        /// Its parameter.
        parameter: &'static str,
        /// The least that it can be.
        lowest: f64,
        /// The most.
        highest: f64,
    },
}

impl From<FileError> for ServoError {
    fn from(error: FileError) -> Self {
        Self::File(Box::new(error))
    }
}

impl ServoError {
    /// What the user can do about it.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Missing { .. } => {
                "add it to [joint.drive]: u = K (goal - q) - D qd is the voltage, k_t u the torque"
            }
            Self::File(_) => "",
            Self::NoLog => "give logs of some seconds in dataset.toml the role \"train\"",
            Self::Effect(_) => {
                "take it out of the model file or the command line; docs/servo-arms.md lists those of servos"
            }
            Self::Value { .. } => "correct the value",
        }
    }
}
