//! Parameter blocks, as they are, and with a header and a checksum that fit.

use firmware::block::{ParameterBlock, VERSION};
use firmware::{BlockError, Controller};

/// Decodes; what is accepted must survive being encoded, and must run.
pub fn run(bytes: &[u8]) {
    let _ = ParameterBlock::decode(bytes);
    match ParameterBlock::decode(&framed(bytes)) {
        Ok(block) => try_out(block),
        Err(error) => {
            let _ = error.to_string();
            assert!(
                !matches!(error, BlockError::Length { .. } | BlockError::Checksum),
                "header and checksum fit"
            );
        }
    }
}

/// The bytes as the body of a block.
pub fn framed(body: &[u8]) -> Vec<u8> {
    let body = &body[..body.len().min(usize::from(u16::MAX))];
    let length = (body.len() as u16).to_le_bytes();
    let content = [&VERSION.to_le_bytes()[..], &length, body].concat();
    let crc = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC);
    let checksum = crc.checksum(&content).to_le_bytes();
    [&content[..], &checksum].concat()
}

/// A checked block is one that the tick can play for a while.
fn try_out(block: ParameterBlock) {
    let mut buffer = [0; firmware::block::MAX_BYTES];
    if let Ok(encoded) = block.encode(&mut buffer) {
        assert!(ParameterBlock::decode(encoded).is_ok(), "an accepted block is accepted again");
    }
    let mut controller = Controller::new(block);
    controller.start();
    for tick in 0..4 {
        controller.tick(&[tick, -tick, i32::MAX - tick]);
    }
}
