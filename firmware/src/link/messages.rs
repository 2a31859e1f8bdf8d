//! Messages to frames and back, for either end.

use super::answer::Answer;
use super::checked::{Kind, MAX_PAYLOAD_BYTES, open, seal};
use super::hello::{self, Hello};
use super::request::Request;
use super::telemetry::Telemetry;
use crate::supervisor::TickRecord;

/// What comes to the host.
#[derive(Clone, Debug, PartialEq)]
pub enum ToHost<'a> {
    /// The board's Hello.
    Hello(Hello),
    /// The answer to a request.
    Answer(Answer<'a>),
    /// A tick.
    Telemetry(Telemetry),
}

/// What comes to the board.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ToBoard<'a> {
    /// The host's Hello, with its version of the protocol.
    Hello {
        /// The host's version.
        protocol_version: u16,
    },
    /// A request.
    Request(Request<'a>),
}

impl Telemetry {
    /// The message of a tick; `dropped` records could not be sent since power-on.
    pub fn new(record: &TickRecord, dropped: u32) -> Self {
        let TickRecord { tick, counts, codes, reference, mode, .. } = *record;
        let TickRecord { state, saturated, fault, tick_time_tenth_us, .. } = *record;
        Self {
            sequence: tick,
            counts,
            codes,
            reference,
            mode,
            state,
            saturated,
            fault,
            tick_time_tenth_us,
            dropped,
        }
    }
}

/// Why a frame is not a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameError {
    /// The checksum does not fit, or the kind is none.
    Broken,
    /// The checksum fits, the content is no message of this build: another build sent it.
    Foreign,
}

impl core::fmt::Display for FrameError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Broken => "the frame's checksum does not fit",
            Self::Foreign => "the frame is intact, but no message of this build",
        })
    }
}

impl core::error::Error for FrameError {}

impl<'a> ToHost<'a> {
    /// The message in a frame's content, as [`crate::frame::FrameReader`] gives it.
    pub fn read(content: &'a [u8]) -> Result<Self, FrameError> {
        let (kind, payload) = open(content).ok_or(FrameError::Broken)?;
        match kind {
            Kind::Hello => Hello::decode(payload).map(Self::Hello),
            Kind::Answer => parse(payload).map(Self::Answer),
            Kind::Telemetry => parse(payload).map(Self::Telemetry),
            Kind::Request => None,
        }
        .ok_or(FrameError::Foreign)
    }

    /// The frame with its zero; `None` if `buffer` is too small.
    ///
    /// A buffer of [`super::MAX_FRAME_BYTES`] is large enough for any message.
    pub fn write<'b>(&self, buffer: &'b mut [u8]) -> Option<&'b [u8]> {
        let mut payload = [0; MAX_PAYLOAD_BYTES];
        match self {
            Self::Hello(hello) => seal(Kind::Hello, &hello.encode(), buffer),
            Self::Answer(answer) => {
                seal(Kind::Answer, postcard::to_slice(answer, &mut payload).ok()?, buffer)
            }
            Self::Telemetry(record) => {
                seal(Kind::Telemetry, postcard::to_slice(record, &mut payload).ok()?, buffer)
            }
        }
    }
}

impl<'a> ToBoard<'a> {
    /// The message in a frame's content, as [`crate::frame::FrameReader`] gives it.
    pub fn read(content: &'a [u8]) -> Result<Self, FrameError> {
        let (kind, payload) = open(content).ok_or(FrameError::Broken)?;
        match kind {
            Kind::Hello => hello::parse_host_hello(payload)
                .map(|protocol_version| Self::Hello { protocol_version }),
            Kind::Request => parse(payload).map(Self::Request),
            Kind::Answer | Kind::Telemetry => None,
        }
        .ok_or(FrameError::Foreign)
    }

    /// The frame with its zero; `None` if `buffer` is too small or a piece too long.
    pub fn write<'b>(&self, buffer: &'b mut [u8]) -> Option<&'b [u8]> {
        let mut payload = [0; MAX_PAYLOAD_BYTES];
        match self {
            Self::Hello { .. } => seal(Kind::Hello, &hello::host_hello(), buffer),
            Self::Request(request) => {
                seal(Kind::Request, postcard::to_slice(request, &mut payload).ok()?, buffer)
            }
        }
    }
}

/// A message that takes all of the bytes.
fn parse<'a, T: serde::Deserialize<'a>>(payload: &'a [u8]) -> Option<T> {
    match postcard::take_from_bytes(payload) {
        Ok((message, [])) => Some(message),
        _ => None,
    }
}
