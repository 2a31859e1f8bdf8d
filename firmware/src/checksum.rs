//! The two checksums: of what is stored, and of what goes over the serial line.

use crc::{CRC_32_ISCSI, CRC_32_ISO_HDLC, Crc, Table};

/// CRC-32 (ISO-HDLC), which ends a parameter block and a record in flash.
pub const CRC_32: Crc<u32> = Crc::<u32>::new(&CRC_32_ISO_HDLC);

/// CRC-32C (Castagnoli) of frames, of blocks on the line and of the latched fault. A table of
/// 256 words makes it quick.
///
/// Not the one that ends a parameter block: over bytes that end with their own checksum, the
/// same one gives the same number whatever they are.
pub static CRC_32C: Crc<u32, Table<1>> = Crc::<u32, Table<1>>::new(&CRC_32_ISCSI);
