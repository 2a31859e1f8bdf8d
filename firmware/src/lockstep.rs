//! Records exchanged with a simulated robot, one request and one reply a tick.
//!
//! Little-endian and of fixed size. The board waits for the robot and the robot
//! for the board, so simulated time is exact however fast either runs.

use embedded_storage::nor_flash::NorFlash;

use crate::block::ParameterBlock;
use crate::store::{Boot, Source, Store};
use crate::{Angle, Controller, DacCode, TickOutput};

/// Length of a request [bytes].
pub const REQUEST_BYTES: usize = 16;
/// Length of a reply [bytes].
pub const REPLY_BYTES: usize = 28;

/// What the robot's side asks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Request {
    /// So many bytes of an encoded [`ParameterBlock`] follow.
    Load {
        /// Bytes that follow.
        length: u32,
    },
    /// Begin the reference.
    Start,
    /// Put out 0 V.
    Stop,
    /// A tick with these counts.
    Tick([i32; 3]),
    /// End the program.
    Quit,
    /// So many bytes of an encoded [`ParameterBlock`] follow, for the store.
    Commit {
        /// Bytes that follow.
        length: u32,
    },
    /// Take the block that the store has.
    Boot,
}

impl Request {
    /// The request as bytes.
    pub fn encode(&self) -> [u8; REQUEST_BYTES] {
        let words = match *self {
            Self::Load { length } => [1, length as i32, 0, 0],
            Self::Start => [2, 0, 0, 0],
            Self::Stop => [3, 0, 0, 0],
            Self::Tick([a, b, c]) => [4, a, b, c],
            Self::Quit => [5, 0, 0, 0],
            Self::Commit { length } => [6, length as i32, 0, 0],
            Self::Boot => [7, 0, 0, 0],
        };
        let mut bytes = [0; REQUEST_BYTES];
        for (slot, word) in bytes.chunks_exact_mut(4).zip(words) {
            slot.copy_from_slice(&word.to_le_bytes());
        }
        bytes
    }

    /// The request in these bytes, if it is one.
    pub fn decode(bytes: &[u8; REQUEST_BYTES]) -> Option<Self> {
        let word =
            |i: usize| i32::from_le_bytes([bytes[i], bytes[i + 1], bytes[i + 2], bytes[i + 3]]);
        match word(0) {
            1 => Some(Self::Load { length: word(4) as u32 }),
            2 => Some(Self::Start),
            3 => Some(Self::Stop),
            4 => Some(Self::Tick([word(4), word(8), word(12)])),
            5 => Some(Self::Quit),
            6 => Some(Self::Commit { length: word(4) as u32 }),
            7 => Some(Self::Boot),
            _ => None,
        }
    }
}

/// What the board answers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Reply {
    /// Whether the request was carried out; a refused block leaves the old one.
    pub accepted: bool,
    /// Bit i - 1: the command of joint i was cut at its limit.
    pub saturated: u8,
    /// Codes put out.
    pub codes: [DacCode; 3],
    /// Where the joints should be.
    pub reference: [Angle; 3],
    /// Counts of the board's timer from counts in to codes out.
    pub timer_counts: u32,
    /// Sequence number in the store: of the block committed, or of the block to begin with.
    pub sequence: u32,
}

impl Reply {
    /// The reply to a tick.
    pub fn to_tick(output: &TickOutput, timer_counts: u32) -> Self {
        let bits = output.saturated.iter().enumerate();
        Self {
            accepted: true,
            saturated: bits.fold(0, |bits, (i, cut)| bits | u8::from(*cut) << i),
            codes: output.codes,
            reference: output.reference,
            timer_counts,
            sequence: 0,
        }
    }

    /// The reply as bytes.
    pub fn encode(&self) -> [u8; REPLY_BYTES] {
        let mut bytes = [0; REPLY_BYTES];
        bytes[0] = u8::from(self.accepted);
        bytes[1] = self.saturated;
        for (slot, code) in bytes[2..8].chunks_exact_mut(2).zip(self.codes) {
            slot.copy_from_slice(&code.0.to_le_bytes());
        }
        for (slot, angle) in bytes[8..20].chunks_exact_mut(4).zip(self.reference) {
            slot.copy_from_slice(&angle.0.to_le_bytes());
        }
        bytes[20..24].copy_from_slice(&self.timer_counts.to_le_bytes());
        bytes[24..28].copy_from_slice(&self.sequence.to_le_bytes());
        bytes
    }

    /// The reply in these bytes.
    pub fn decode(bytes: &[u8; REPLY_BYTES]) -> Self {
        let word =
            |i: usize| i32::from_le_bytes([bytes[i], bytes[i + 1], bytes[i + 2], bytes[i + 3]]);
        let code = |i: usize| DacCode(i16::from_le_bytes([bytes[i], bytes[i + 1]]));
        Self {
            accepted: bytes[0] != 0,
            saturated: bytes[1],
            codes: [code(2), code(4), code(6)],
            reference: [word(8), word(12), word(16)].map(Angle),
            timer_counts: word(20) as u32,
            sequence: word(24) as u32,
        }
    }
}

/// The board's side of the conversation, with or without a board.
#[derive(Debug, Default)]
pub struct Responder {
    controller: Option<Controller>,
}

impl Responder {
    /// Whether there is a controller.
    pub fn is_loaded(&self) -> bool {
        self.controller.is_some()
    }

    /// Takes a block in place of the old one; refuses a broken one and keeps the old.
    pub fn load(&mut self, bytes: &[u8]) -> Reply {
        let block = ParameterBlock::decode(bytes);
        let accepted = block.is_ok();
        if let Ok(block) = block {
            self.controller = Some(Controller::new(block));
        }
        Reply { accepted, ..Reply::default() }
    }

    /// Takes the block to begin with, the safe defaults too; accepted if it is from a slot.
    pub fn boot(&mut self, boot: &Boot) -> Reply {
        self.controller = Some(Controller::new(boot.block.clone()));
        match boot.source {
            Source::Newest { sequence, .. } | Source::Other { sequence, .. } => {
                Reply { accepted: true, sequence, ..Reply::default() }
            }
            Source::Defaults => Reply::default(),
        }
    }

    /// Answers every other request; `timer` is read before and after a tick.
    pub fn answer(&mut self, request: Request, timer: impl Fn() -> u32) -> Reply {
        let Some(controller) = &mut self.controller else {
            return Reply::default();
        };
        match request {
            Request::Tick(counts) => {
                let before = timer();
                let output = controller.tick(&counts);
                let taken = timer().wrapping_sub(before);
                controller.prepare();
                return Reply::to_tick(&output, taken);
            }
            Request::Start => {
                controller.start();
                controller.prepare();
            }
            Request::Stop => controller.stop(),
            Request::Load { .. } | Request::Quit | Request::Commit { .. } | Request::Boot => {}
        }
        Reply { accepted: true, ..Reply::default() }
    }
}

/// Puts an encoded block into the store.
pub fn commit<F: NorFlash>(store: &mut Store<F>, encoded: &[u8]) -> Reply {
    match store.commit(encoded) {
        Ok(stored) => Reply { accepted: true, sequence: stored.sequence, ..Reply::default() },
        Err(_) => Reply::default(),
    }
}
