//! Parameter blocks between host and board.

use firmware::ParameterBlock;
use firmware::block::MAX_BYTES;
use firmware::checksum::CRC_32C;
use firmware::link::{Command, PIECE_BYTES, Parameters, Source};

use super::client::Client;
use super::error::LinkError;
use super::reply::OwnedReply;

/// Sends an encoded block and has the board store it for good, read it back and use it.
///
/// # Errors
/// The line, or the board's reason to refuse it; the board then goes on as before.
pub fn commit(client: &mut Client, encoded: &[u8]) -> Result<Parameters, LinkError> {
    send(client, encoded)?;
    finish(client, Command::Commit)
}

/// Sends an encoded block and has the board use it until the next reset.
///
/// # Errors
/// As of [`commit`].
pub fn put_into_use(client: &mut Client, encoded: &[u8]) -> Result<Parameters, LinkError> {
    send(client, encoded)?;
    finish(client, Command::Use)
}

fn send(client: &mut Client, encoded: &[u8]) -> Result<(), LinkError> {
    let checksum = CRC_32C.checksum(encoded);
    client.execute(Command::UploadBegin { length: encoded.len() as u16, checksum })?;
    for (index, bytes) in encoded.chunks(PIECE_BYTES).enumerate() {
        let offset = (index * PIECE_BYTES) as u16;
        client.execute(Command::UploadPiece { offset, bytes })?;
    }
    Ok(())
}

fn finish(client: &mut Client, command: Command<'_>) -> Result<Parameters, LinkError> {
    match client.request(command)? {
        OwnedReply::InUse(parameters) => Ok(parameters),
        _ => Err(LinkError::UnexpectedAnswer("the end of an upload")),
    }
}

/// Fetches an encoded block and checks that it is the one that the board announces.
///
/// # Errors
/// The line, a board without such a block, or one whose block changes meanwhile.
pub fn download(client: &mut Client, source: Source) -> Result<Vec<u8>, LinkError> {
    let mut block = Vec::new();
    loop {
        let offset = block.len() as u16;
        let reply = client.request(Command::Download { source, offset })?;
        let OwnedReply::Piece { length, checksum: announced, bytes } = reply else {
            return Err(LinkError::UnexpectedAnswer("a download"));
        };
        block.extend_from_slice(&bytes);
        let is_whole = bytes.is_empty() || block.len() >= usize::from(length);
        if is_whole || block.len() > MAX_BYTES {
            let found = CRC_32C.checksum(&block);
            return match found == announced {
                true => Ok(block),
                false => Err(LinkError::Checksum { found, announced }),
            };
        }
    }
}

/// A block as it goes over the line.
///
/// # Errors
/// It has more bytes than a block may.
pub fn encoded(block: &ParameterBlock) -> Result<Vec<u8>, LinkError> {
    let mut buffer = [0; MAX_BYTES];
    Ok(block.encode(&mut buffer).map_err(LinkError::Encode)?.to_vec())
}

/// Fetches a block and decodes it.
///
/// # Errors
/// As of [`download`]; or a block of another build.
pub fn download_block(client: &mut Client, source: Source) -> Result<ParameterBlock, LinkError> {
    ParameterBlock::decode(&download(client, source)?).map_err(LinkError::Decode)
}

/// Fetches both of the board's blocks and holds them byte for byte against what was sent.
///
/// # Errors
/// The line, or the first byte that differs.
pub fn compare(client: &mut Client, sent: &[u8]) -> Result<(), LinkError> {
    for which in [Source::Stored, Source::InUse] {
        let found = download(client, which)?;
        if found != sent {
            let same = found.iter().zip(sent).take_while(|(a, b)| a == b).count();
            return Err(LinkError::ReadBack { which, offset: same });
        }
    }
    Ok(())
}
