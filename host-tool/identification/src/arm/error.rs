//! Why an arm cannot be identified.

/// The message names the joint or log, [`ArmError::hint`] the cure.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ArmError {
    /// A drive whose command is a goal.
    #[error(
        "joint {joint} is driven by a position servo, whose log holds goals and no voltage: \
         `rrr identify` reads the commands of voltage, current and torque drives only"
    )]
    PositionServo {
        /// Its number, from 1.
        joint: usize,
    },
    /// A drive of unknown strength.
    #[error("joint {joint} has no torque constant, without which its command says nothing of mass")]
    NoTorqueConstant {
        /// Its number, from 1.
        joint: usize,
    },
    /// Nothing to fit to.
    #[error("the data set has no log with role \"train\"")]
    NoLog,
    /// Logs without a stretch that is long enough.
    #[error(
        "{file}: its longest unbroken stretch is {longest_s:.2} s, but at {rate_hz:.0} Hz and this \
         encoder {needed_s:.2} s are needed"
    )]
    TooShort {
        /// The log.
        file: String,
        /// What is there [s].
        longest_s: f64,
        /// What must be there [s].
        needed_s: f64,
        /// Its rate [Hz].
        rate_hz: f64,
    },
    /// No joint moves.
    #[error("no joint moves in the logs with role \"train\" for long enough")]
    NoMotion,
    /// The search failed.
    #[error("no parameters fit: {0}")]
    Numerical(String),
}

impl ArmError {
    /// What the user can do about it.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::PositionServo { .. } => {
                "log the drive's voltage, current or torque, and say so in [joint.drive]"
            }
            Self::NoTorqueConstant { .. } => {
                "add torque_constant_Nm_per_V (or _per_A) to [joint.drive], or log the torque"
            }
            Self::NoLog => "give one log in dataset.toml the role \"train\"",
            Self::TooShort { .. } => "record a longer motion, or take the log out of dataset.toml",
            Self::NoMotion => "record motions in which the joints turn both ways",
            Self::Numerical(_) => "look at the logs and at the geometry in the robot file",
        }
    }
}
