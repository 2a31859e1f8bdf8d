//! What the board's end of a conversation remembers from request to request.

use heapless::Vec;

use super::answer::{Origin, Parameters};
use super::block_store::BlockStore;
use super::checked::MAX_FRAME_BYTES;
use super::hello::Hello;
use super::key::{Key, Nonce, Nonces};
use super::upload::{Block, Upload};
use crate::block::HardLimits;
use crate::checksum::CRC_32C;
use crate::supervisor::FaultRecord;

/// What the handler begins with, found by the boot.
#[derive(Clone, Debug)]
pub struct HandlerConfig<'a> {
    /// Name of the board, for the Hello.
    pub board: &'a str,
    /// What no block may exceed here.
    pub limits: HardLimits,
    /// From the board's random generator; challenges are made of it.
    pub nonce_seed: [u8; 16],
    /// The stored key.
    pub key: Option<Key>,
    /// The stored fault.
    pub fault: Option<FaultRecord>,
    /// The encoded block in use and where it comes from.
    pub in_use: Option<(&'a [u8], Origin)>,
}

/// All but the reader, whose frames are handled.
#[derive(Debug)]
pub(super) struct Conversation<S> {
    pub(super) hello: Hello,
    pub(super) limits: HardLimits,
    pub(super) store: S,
    pub(super) key: Option<Key>,
    pub(super) stored_fault: Option<FaultRecord>,
    /// The fault that the store was asked to take last, and how often it did not.
    pub(super) fault_to_store: Option<FaultRecord>,
    pub(super) store_failures: u8,
    pub(super) nonces: Nonces,
    pub(super) nonce: Option<Nonce>,
    /// `None` until there was a Hello, then the newest request of this conversation.
    pub(super) last_request: Option<Option<LastRequest>>,
    /// Whether that one was not refused.
    pub(super) was_carried_out: bool,
    /// The answer to it.
    pub(super) answer: Vec<u8, MAX_FRAME_BYTES>,
    /// An answer to a request out of its turn.
    pub(super) out_of_turn_answer: Vec<u8, MAX_FRAME_BYTES>,
    pub(super) upload: Upload,
    pub(super) in_use: Block,
    pub(super) parameters: Option<Parameters>,
    pub(super) streaming: bool,
    pub(super) heard: bool,
    pub(super) telemetry_dropped: u32,
    pub(super) requests: u32,
    pub(super) foreign_frames: u32,
}

/// A request that was answered: its number, and its frame's checksum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LastRequest {
    pub(super) number: u32,
    pub(super) checksum: Option<[u8; 4]>,
}

impl<S: BlockStore> Conversation<S> {
    /// A conversation before its Hello.
    pub(super) fn new(store: S, config: &HandlerConfig<'_>) -> Self {
        let in_use = config.in_use.and_then(|(bytes, _)| Block::from_slice(bytes).ok());
        let parameters = config.in_use.map(|(bytes, origin)| parameters(bytes, origin));
        Self {
            hello: Hello::of_this_build(config.board),
            limits: config.limits,
            store,
            key: config.key,
            stored_fault: config.fault,
            fault_to_store: None,
            store_failures: 0,
            nonces: Nonces::new(config.nonce_seed),
            nonce: None,
            last_request: None,
            was_carried_out: false,
            answer: Vec::new(),
            out_of_turn_answer: Vec::new(),
            upload: Upload::default(),
            in_use: in_use.unwrap_or_default(),
            parameters,
            streaming: false,
            heard: false,
            telemetry_dropped: 0,
            requests: 0,
            foreign_frames: 0,
        }
    }
}

/// What there is to tell about an encoded block.
pub(super) fn parameters(bytes: &[u8], origin: Origin) -> Parameters {
    Parameters { origin, length: bytes.len() as u16, checksum: CRC_32C.checksum(bytes) }
}
