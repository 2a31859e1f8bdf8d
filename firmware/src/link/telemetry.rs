//! What the board sends every tick; types only, as the schema hash is taken of this text.
//!
//! On the line at 921,600 baud, 10 bits a byte, a tick of 1 ms has room for 92.16 bytes.
//! A record takes at most, each number as a varint of 7 bits a byte:
//!
//! | part | bytes |
//! | --- | --- |
//! | kind of frame | 1 |
//! | sequence | 5 |
//! | counts, 3 of 32 bits | 15 |
//! | codes, 3 of 16 bits | 9 |
//! | reference, 3 of 32 bits | 15 |
//! | modes 3, state 1, saturated 1 | 5 |
//! | fault and joint, with the byte that says there is one | 3 |
//! | tick time 3, dropped 5 | 8 |
//! | CRC-32C | 4 |
//! | COBS's own byte and the zero | 2 |
//! | **sum** | **67** |
//!
//! That leaves 25 bytes a tick, a quarter of the line, for answers.

use serde::{Deserialize, Serialize};

use crate::Mode;
use crate::supervisor::fault::{Fault, State};
use crate::{Angle, DacCode};

/// One tick.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Telemetry {
    /// The tick's number since power-on: a gap is as many records lost.
    pub sequence: u32,
    /// Encoder counts from the model's zero, once it is set, sampled at the beginning of the tick.
    pub counts: [i32; 3],
    /// Codes put out in this tick, all zero unless Running.
    pub codes: [DacCode; 3],
    /// Where the joints should be at this tick; zero unless Running.
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
    /// Records that the board could not send since power-on, of those that were to be sent.
    pub dropped: u32,
}
