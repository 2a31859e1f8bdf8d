//! A parameter block as bytes, and back: version, length, postcard, CRC-32.

use model::ParameterError;

use super::parameters::ParameterBlock;
use crate::checksum::{CRC_32, CRC_32C};

/// Version of the layout of [`ParameterBlock`]; a block of another version is refused.
///
/// Version 1 had no compensations, version 2 no safety limits, version 3 no tables,
/// version 4 neither the tolerance of a start nor limits of position, version 5 neither joints in use
/// nor what motors bear.
pub const VERSION: u16 = 6;
/// No encoded block is longer [bytes]; with a record's header it fits a page of 2 KiB.
pub const MAX_BYTES: usize = 1984;

const HEADER_BYTES: usize = 4;
const CHECKSUM_BYTES: usize = 4;

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
    /// The checksum is right, but the bytes are not a block of this layout.
    Layout,
    /// A value out of its bounds.
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
                    "the block has version {found}, this build knows version {VERSION}: build it again"
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
    ///
    /// # Errors
    /// The buffer is too short.
    pub fn encode<'a>(&self, buffer: &'a mut [u8]) -> Result<&'a [u8], BlockError> {
        let room = buffer.len().saturating_sub(CHECKSUM_BYTES).max(HEADER_BYTES);
        let body = buffer.get_mut(HEADER_BYTES..room).ok_or(BlockError::Layout)?;
        let body_length = postcard::to_slice(self, body).map_err(|_| BlockError::Layout)?.len();
        let end = HEADER_BYTES + body_length;
        // No index that could panic: the tick checks its parameters with this.
        let short = BlockError::Layout;
        let (content, rest) = buffer.split_at_mut_checked(end).ok_or(short)?;
        let [v0, v1] = VERSION.to_le_bytes();
        let [l0, l1] = (body_length as u16).to_le_bytes();
        *content.first_chunk_mut::<HEADER_BYTES>().ok_or(short)? = [v0, v1, l0, l1];
        let checksum = CRC_32.checksum(content).to_le_bytes();
        *rest.first_chunk_mut::<CHECKSUM_BYTES>().ok_or(short)? = checksum;
        buffer.get(..end + CHECKSUM_BYTES).ok_or(short)
    }

    /// [`CRC_32C`] of the encoded block, as its identity; 0 if it cannot be encoded.
    pub fn fingerprint(&self) -> u32 {
        let mut buffer = [0; MAX_BYTES];
        self.encode(&mut buffer).map_or(0, |bytes| CRC_32C.checksum(bytes))
    }

    /// Reads a block and checks every value in it.
    ///
    /// # Errors
    /// The bytes are incomplete, damaged or of another version, or a value is out of its bounds.
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
    if CRC_32.checksum(content) != u32::from_le_bytes(*checksum) {
        return Err(BlockError::Checksum);
    }
    if version != VERSION {
        return Err(BlockError::Version { found: version });
    }
    Ok(body)
}
