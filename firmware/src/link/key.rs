//! The key: who has it may upload, arm, run and clear faults; who replays may not.
//!
//! A proof is HMAC-SHA-256 over the board's last challenge, the request's number and
//! its command. The challenge is never the same twice and dies with the next Hello
//! or reset, numbers only rise in between: so no request is ever right twice.

use hmac::{Hmac, Mac};
use sha2::{Digest, Sha256};

use super::request::{Command, Request};
use crate::supervisor::Order;

/// A key of 32 bytes.
pub type Key = [u8; 32];
/// What the board answers to a challenge.
pub type Nonce = [u8; 16];
/// What a request brings along.
pub type Proof = [u8; 32];

/// Longest command in postcard [bytes].
const MAX_COMMAND_BYTES: usize = super::request::PIECE_BYTES + 8;

/// The proof of a command under this number.
///
/// `None` if the command holds more bytes than a piece may.
pub fn proof(key: &Key, nonce: &Nonce, number: u32, command: &Command<'_>) -> Option<Proof> {
    Some(mac(key, nonce, number, command)?.finalize().into_bytes().into())
}

/// Whether a request's proof is right; takes as long for any wrong one.
pub fn is_proven(key: &Key, nonce: &Nonce, request: &Request<'_>) -> bool {
    let mac = mac(key, nonce, request.number, &request.command);
    match (mac, &request.proof) {
        (Some(mac), Some(proof)) => mac.verify_slice(proof).is_ok(),
        _ => false,
    }
}

fn mac(key: &Key, nonce: &Nonce, number: u32, command: &Command<'_>) -> Option<Hmac<Sha256>> {
    let mut buffer = [0; MAX_COMMAND_BYTES];
    let command = postcard::to_slice(command, &mut buffer).ok()?;
    let mut mac = Hmac::<Sha256>::new_from_slice(key).ok()?;
    mac.update(nonce);
    mac.update(&number.to_le_bytes());
    mac.update(command);
    Some(mac)
}

/// Makes challenges.
#[derive(Clone, Debug)]
pub struct Nonces {
    seed: [u8; 16],
    given: u64,
}

impl Nonces {
    /// From what the board's random generator gave at power-on.
    pub const fn new(seed: [u8; 16]) -> Self {
        Self { seed, given: 0 }
    }

    /// The next one.
    pub fn next_nonce(&mut self) -> Nonce {
        self.given = self.given.wrapping_add(1);
        let hash = Sha256::new().chain_update(self.seed).chain_update(self.given.to_le_bytes());
        let hash: [u8; 32] = hash.finalize().into();
        let mut nonce = [0; 16];
        nonce.copy_from_slice(&hash[..16]);
        nonce
    }
}

impl Command<'_> {
    /// The order of a stop or disarm command, which is always carried out.
    pub(super) fn stopping_order(&self) -> Option<Order> {
        match self {
            Self::Stop => Some(Order::Stop),
            Self::Disarm => Some(Order::Disarm),
            _ => None,
        }
    }

    /// Whether a board with a key asks for a proof.
    pub fn needs_proof(&self) -> bool {
        match self {
            Self::UploadBegin { .. }
            | Self::UploadPiece { .. }
            | Self::Use
            | Self::Commit
            | Self::Arm
            | Self::Run { .. }
            | Self::ClearFault
            | Self::Home { .. }
            | Self::SetKey { .. } => true,
            Self::Query
            | Self::Stream { .. }
            | Self::Challenge
            | Self::Download { .. }
            | Self::Stop
            | Self::Disarm => false,
        }
    }
}
