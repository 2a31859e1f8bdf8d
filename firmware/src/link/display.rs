//! Refusals and origins in words, for the host's messages.

use core::fmt::{Display, Formatter, Result};

use super::answer::{BlockRefusal, Origin, Refusal, StoreRefusal};

impl Display for Refusal {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Self::HelloFirst => f.write_str("the board was reset; connect to it again"),
            Self::OldNumber { newest } => {
                write!(f, "the request's number is not above {newest}, which was answered already")
            }
            Self::NotNow { state } => write!(f, "the board is {state}"),
            Self::Proof => f.write_str("the board has a key, and the request does not prove it"),
            Self::NoParameters => f.write_str("the board has no parameters"),
            Self::Implausible { joint, why } => write!(f, "joint {joint}: {why}"),
            Self::FarFromStart { joint, distance_rad } => {
                write!(f, "joint {joint} is {distance_rad:.3} rad from where its reference begins")
            }
            Self::EmergencyStop => {
                f.write_str("the emergency stop is pressed, or its wire is broken")
            }
            Self::NoDrivePower => {
                f.write_str("the amplifiers have no power, or the wire that says so is broken")
            }
            Self::OutsideRange { joint, position_rad } => {
                write!(f, "joint {joint} is at {position_rad:.3} rad, outside its range")
            }
            Self::FaultPersists => f.write_str("the cause of the fault is still there"),
            Self::Upload { taken } => {
                write!(f, "the upload is out of step: the board has {taken} bytes of it")
            }
            Self::Block(why) => write!(f, "the board refuses the parameter block: {why}"),
            Self::Store(why) => write!(f, "the board's store: {why}"),
            Self::StoredNotInUse => {
                f.write_str("the block is stored for the next reset, but not in use: a fault came")
            }
        }
    }
}

impl core::error::Error for Refusal {}

impl Display for BlockRefusal {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Self::Length => f.write_str("its length is not the one announced, or too long"),
            Self::Version { found } => write!(
                f,
                "it has version {found}, the firmware knows version {}",
                crate::block::VERSION
            ),
            Self::Checksum => f.write_str("its checksum does not fit"),
            Self::Layout => f.write_str("its bytes are no parameter block"),
            Self::Value { name, joint: 0, value, must } => {
                write!(f, "{name} is {value}, but must {must}")
            }
            Self::Value { name, joint, value, must } => {
                write!(f, "{name} of joint {joint} is {value}, but must {must}")
            }
        }
    }
}

impl Display for StoreRefusal {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.write_str(match self {
            Self::Write => "it could not be erased or written",
            Self::ReadBack => "what was read back is not what was written",
            Self::Empty => "nothing valid is stored",
            Self::TooLong => "the block does not fit",
        })
    }
}

impl Display for Origin {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.write_str(match self {
            Self::Newest => "the newest in the store",
            Self::Older => "the older one in the store; the newer one is damaged",
            Self::SafeDefaults => "safe defaults, feedforward off; nothing valid is stored",
            Self::Uploaded => "uploaded, until the next reset",
        })
    }
}
