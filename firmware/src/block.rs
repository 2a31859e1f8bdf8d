//! The parameter block: everything that the tick must know, in one checked piece.
//!
//! On the wire and in store: version, length, postcard, CRC-32. Nothing of it is
//! compiled in; a board without a block puts out 0 V.

use crc::{CRC_32_ISO_HDLC, Crc};
use model::{ParameterError, Robot};
use serde::{Deserialize, Serialize};

use crate::compensation::{Compensations, Outside};
use crate::link::checked::CHECKSUM as LINE_CHECKSUM;
use crate::mode::Mode;
use crate::reference::Reference;
use crate::supervisor::SafetyLimits;

/// Version of the layout below; a block of another version is refused.
///
/// Version 1 had no compensations, version 2 no safety limits.
pub const VERSION: u16 = 3;
/// No encoded block is longer [bytes].
pub const MAX_BYTES: usize = 1024;

const HEADER_BYTES: usize = 4;
const CHECKSUM_BYTES: usize = 4;
const CHECKSUM: Crc<u32> = Crc::<u32>::new(&CRC_32_ISO_HDLC);

/// Model, gains, limits and reference.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ParameterBlock {
    /// The model of the arm and its friction.
    pub robot: Robot<f32>,
    /// Encoder counts per turn of a joint.
    pub encoder_counts_per_turn: u32,
    /// Time from tick to tick [s].
    pub sample_period_s: f32,
    /// Feedback gains of each joint.
    pub gains: [Gains; 3],
    /// Bandwidth of each joint's velocity estimate [rad/s].
    pub velocity_bandwidth_rad_per_s: [f32; 3],
    /// Largest command [V], at most what the converter can put out.
    pub command_limit_v: f32,
    /// What each joint's command is made of.
    pub mode: [Mode; 3],
    /// What the board plays.
    pub reference: Reference,
    /// What is made up for at each joint beyond the model.
    pub compensations: [Compensations; 3],
    /// What is made up for from outside the arm.
    pub outside: Option<Outside>,
    /// Beyond which the supervisor ends a run.
    pub safety: SafetyLimits,
}

/// PD gains of one joint, eq. (17).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Gains {
    /// Proportional gain k_p [V/rad].
    pub proportional_v_per_rad: f32,
    /// Derivative gain k_d [V s/rad].
    pub derivative_v_s_per_rad: f32,
}

/// Why a block was refused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BlockError {
    /// Fewer bytes than the header announces, or more.
    Length {
        /// Bytes there.
        found: usize,
        /// Bytes announced.
        announced: usize,
    },
    /// A layout that this build does not know.
    Version {
        /// Version found.
        found: u16,
    },
    /// The checksum does not fit the bytes.
    Checksum,
    /// The bytes are not a block, though the checksum fits.
    Layout,
    /// A value that no robot, or not this board, can have.
    Parameter(ParameterError),
}

impl core::fmt::Display for BlockError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Length { found, announced } => {
                write!(f, "the block has {found} bytes, its header announces {announced}")
            }
            Self::Version { found } => {
                write!(
                    f,
                    "the block has version {found}, this build knows version {VERSION}: build it anew"
                )
            }
            Self::Checksum => write!(f, "the block's checksum does not fit its bytes"),
            Self::Layout => write!(f, "the block's bytes are not a parameter block"),
            Self::Parameter(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for BlockError {}

impl From<ParameterError> for BlockError {
    fn from(error: ParameterError) -> Self {
        Self::Parameter(error)
    }
}

impl ParameterBlock {
    /// Writes the block into `buffer` (at least [`MAX_BYTES`]), returns the bytes written.
    pub fn encode<'a>(&self, buffer: &'a mut [u8]) -> Result<&'a [u8], BlockError> {
        let room = buffer.len().saturating_sub(CHECKSUM_BYTES).max(HEADER_BYTES);
        let body = buffer.get_mut(HEADER_BYTES..room).ok_or(BlockError::Layout)?;
        let body_length = postcard::to_slice(self, body).map_err(|_| BlockError::Layout)?.len();
        let end = HEADER_BYTES + body_length;
        buffer[0..2].copy_from_slice(&VERSION.to_le_bytes());
        buffer[2..4].copy_from_slice(&(body_length as u16).to_le_bytes());
        let checksum = CHECKSUM.checksum(&buffer[..end]);
        buffer[end..end + CHECKSUM_BYTES].copy_from_slice(&checksum.to_le_bytes());
        Ok(&buffer[..end + CHECKSUM_BYTES])
    }

    /// [`LINE_CHECKSUM`] of the encoded block, which tells one from another; 0 without encoding.
    pub fn fingerprint(&self) -> u32 {
        let mut buffer = [0; MAX_BYTES];
        self.encode(&mut buffer).map_or(0, |bytes| LINE_CHECKSUM.checksum(bytes))
    }

    /// Reads a block and checks every value in it.
    pub fn decode(bytes: &[u8]) -> Result<Self, BlockError> {
        let body = checked_body(bytes)?;
        let (block, rest): (Self, _) =
            postcard::take_from_bytes(body).map_err(|_| BlockError::Layout)?;
        if !rest.is_empty() {
            return Err(BlockError::Layout);
        }
        block.check()?;
        Ok(block)
    }
}

/// The bytes between header and checksum, once both fit.
fn checked_body(bytes: &[u8]) -> Result<&[u8], BlockError> {
    const AROUND: usize = HEADER_BYTES + CHECKSUM_BYTES;
    let short = BlockError::Length { found: bytes.len(), announced: AROUND };
    let (content, checksum) = bytes.split_last_chunk::<CHECKSUM_BYTES>().ok_or(short)?;
    let (header, body) = content.split_first_chunk::<HEADER_BYTES>().ok_or(short)?;
    let version = u16::from_le_bytes([header[0], header[1]]);
    let announced = usize::from(u16::from_le_bytes([header[2], header[3]])) + AROUND;
    if bytes.len() != announced {
        return Err(BlockError::Length { found: bytes.len(), announced });
    }
    if CHECKSUM.checksum(content) != u32::from_le_bytes(*checksum) {
        return Err(BlockError::Checksum);
    }
    if version != VERSION {
        return Err(BlockError::Version { found: version });
    }
    Ok(body)
}
