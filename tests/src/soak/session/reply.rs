//! An answer of the board, as the soak keeps it.

use firmware::link::{Reply, Report};

/// An answer without what it borrows.
#[derive(Clone, Debug)]
pub(super) enum OwnedReply {
    Done,
    Report(Report),
    Piece(Vec<u8>),
}

impl OwnedReply {
    pub(super) fn of(reply: Reply<'_>) -> Self {
        match reply {
            Reply::Report(report) => Self::Report(report),
            Reply::Piece { bytes, .. } => Self::Piece(bytes.to_vec()),
            Reply::Done | Reply::InUse(_) | Reply::Challenge { .. } => Self::Done,
        }
    }
}
