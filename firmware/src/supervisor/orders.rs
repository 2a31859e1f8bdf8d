//! Orders to the supervisor between two ticks, and why they are refused.

use super::fault::{Implausible, State};
use crate::Angle;

/// A change of state that is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// From Disarmed to Armed.
    Arm,
    /// From Armed to Running.
    Run {
        /// Ticks that the host may be silent; `None`: for ever.
        host_timeout_ticks: Option<u32>,
    },
    /// From Running to Armed.
    Stop,
    /// From Armed or Running to Disarmed.
    Disarm,
    /// From Faulted to Disarmed.
    ClearFault,
    /// Sets the position of the joints, which are at rest; only Disarmed.
    Home {
        /// Where each joint is.
        position: [Angle; 3],
    },
}

/// Why an order is not carried out; nothing has changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OrderError {
    /// Not in this state.
    NotNow {
        /// The state.
        state: State,
    },
    /// No parameter block is in use.
    NoParameters,
    /// An estimate cannot be right.
    Implausible {
        /// The joint, 1 to 3.
        joint: u8,
        /// What is wrong.
        why: Implausible,
    },
    /// The reference begins too far from where the joint is.
    FarFromStart {
        /// The joint, 1 to 3.
        joint: u8,
        /// How far [rad].
        distance_rad: f32,
    },
    /// The cause of the fault is still there.
    FaultPersists,
    /// The emergency stop is pressed, or its wire is broken.
    EmergencyStop,
    /// The amplifiers have no power, or the wire that says so is broken.
    NoDrivePower,
    /// A joint is outside its range.
    OutsideRange {
        /// The joint, 1 to 3.
        joint: u8,
        /// Where it is [rad].
        position_rad: f32,
    },
}
