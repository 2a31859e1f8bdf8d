//! The parameter block: everything that the tick must know, in one checked piece.
//!
//! On the line and in the store it is version, length, postcard, CRC-32. None of its values is
//! compiled in; a board without a block puts out 0 V.

mod check;
mod encoding;
mod hard_limits;
mod motor_heating;
mod parameters;
mod parts;
mod position_limits;
mod rig_ranges;
mod safety_limits;

pub use encoding::{BlockError, MAX_BYTES, VERSION};
pub use hard_limits::HardLimits;
pub use motor_heating::MotorHeating;
pub use parameters::{Gains, ParameterBlock};
pub use parts::{Fingerprints, PARTS};
pub use position_limits::PositionLimits;
pub use safety_limits::SafetyLimits;
