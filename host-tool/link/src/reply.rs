//! Replies that own their bytes, and the names of commands.

use firmware::link::{Command, Nonce, Parameters, Reply, Report};

/// A [`Reply`] that owns its bytes.
#[derive(Clone, Debug, PartialEq)]
pub enum OwnedReply {
    /// The command was carried out.
    Done,
    /// The board's state.
    Report(Box<Report>),
    /// What proofs are made with.
    Challenge(Nonce),
    /// A piece of a block of that length and CRC-32C.
    Piece {
        /// Bytes of the whole block.
        length: u16,
        /// CRC-32C of the whole block.
        checksum: u32,
        /// The piece.
        bytes: Vec<u8>,
    },
    /// The block is in use.
    InUse(Parameters),
}

impl From<Reply<'_>> for OwnedReply {
    fn from(reply: Reply<'_>) -> Self {
        match reply {
            Reply::Done => Self::Done,
            Reply::Report(report) => Self::Report(Box::new(report)),
            Reply::Challenge { nonce } => Self::Challenge(nonce),
            Reply::Piece { length, checksum, bytes } => {
                Self::Piece { length, checksum, bytes: bytes.to_vec() }
            }
            Reply::InUse(parameters) => Self::InUse(parameters),
        }
    }
}

/// What a command is called in messages.
pub(super) fn command_name(command: &Command<'_>) -> &'static str {
    match command {
        Command::Query => "query",
        Command::Stream { .. } => "stream",
        Command::Challenge => "challenge",
        Command::UploadBegin { .. } => "upload",
        Command::UploadPiece { .. } => "upload of a piece",
        Command::Use => "use of the block",
        Command::Commit => "commit",
        Command::Download { .. } => "download",
        Command::Arm => "arm",
        Command::Run { .. } => "run",
        Command::Stop => "stop",
        Command::Disarm => "disarm",
        Command::ClearFault => "clear the fault",
        Command::Home { .. } => "home",
        Command::SetKey { .. } => "set the key",
    }
}
