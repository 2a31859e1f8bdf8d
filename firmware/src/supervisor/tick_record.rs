//! The outputs of a tick, for the converter, the host and the log.

use super::fault::{Fault, State};
use crate::{Angle, DacCode, Mode};

/// The outputs of one tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TickRecord {
    /// The tick's number since power-on.
    pub tick: u32,
    /// Encoder counts from the model's zero, once it is set, sampled at the beginning of the tick.
    pub counts: [i32; 3],
    /// Codes for the converter, all zero unless Running.
    pub codes: [DacCode; 3],
    /// Reference angles at this tick; zero unless Running.
    pub reference: [Angle; 3],
    /// The joints' modes.
    pub mode: [Mode; 3],
    /// The state in which the tick ended.
    pub state: State,
    /// Bit i - 1: the command of joint i was cut at its limit.
    pub saturated: u8,
    /// The first cause, and its joint (1 to 3, or 0), while Faulted.
    pub fault: Option<(Fault, u8)>,
    /// From the tick's beginning to the codes, of the tick before this one [0.1 us].
    pub tick_time_tenth_us: u16,
}
