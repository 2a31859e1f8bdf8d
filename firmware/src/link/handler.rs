//! The command handler: bytes of the line in, answers out.
//!
//! Runs outside the tick and never waits for the line. A request is carried out once,
//! however often it comes: the last answer is kept and given again when the same
//! request comes again.

use heapless::Vec;

use super::answer::{Answer, Origin, Parameters, Refusal, Reply};
use super::checked::MAX_FRAME_BYTES;
use super::commands::parameters;
use super::desk::{BlockStore, Desk};
use super::hello::Hello;
use super::key::{Key, Nonce, Nonces};
use super::messages::{ToBoard, ToHost};
use super::request::PIECE_BYTES;
use super::upload::{Block, Upload};
use crate::frame::FrameReader;
use crate::supervisor::{FaultRecord, HardLimits, Order};

/// What the handler begins with, found by the boot.
#[derive(Clone, Debug)]
pub struct Beginning<'a> {
    /// Name of the board, for the Hello.
    pub board: &'a str,
    /// What no block may exceed here.
    pub limits: HardLimits,
    /// From the board's random generator; challenges are made of it.
    pub nonce_seed: [u8; 16],
    /// The key that is kept.
    pub key: Option<Key>,
    /// The fault that is kept.
    pub fault: Option<FaultRecord>,
    /// The encoded block in use and where it comes from.
    pub in_use: Option<(&'a [u8], Origin)>,
}

/// The board's end of the conversation.
#[derive(Debug)]
pub struct Handler<S> {
    reader: FrameReader,
    conversation: Conversation<S>,
}

/// All but the reader, whose frames are handled.
#[derive(Debug)]
pub(super) struct Conversation<S> {
    pub(super) hello: Hello,
    pub(super) limits: HardLimits,
    pub(super) store: S,
    pub(super) key: Option<Key>,
    pub(super) kept_fault: Option<FaultRecord>,
    /// What the store was asked to keep last, and how often it did not.
    pub(super) fault_to_keep: Option<FaultRecord>,
    pub(super) failures_to_keep: u8,
    pub(super) nonces: Nonces,
    pub(super) nonce: Option<Nonce>,
    /// `None` until there was a Hello, then the newest request of this conversation.
    newest: Option<Option<Newest>>,
    /// Whether that one was not refused.
    was_carried_out: bool,
    /// The answer to it.
    pub(super) answer: Vec<u8, MAX_FRAME_BYTES>,
    /// An answer to a request out of its turn.
    pub(super) aside: Vec<u8, MAX_FRAME_BYTES>,
    pub(super) upload: Upload,
    pub(super) in_use: Block,
    pub(super) parameters: Option<Parameters>,
    pub(super) streaming: bool,
    pub(super) heard: bool,
    pub(super) telemetry_dropped: u32,
    pub(super) requests: u32,
    pub(super) foreign: u32,
}

/// A request that was answered: its number, and its frame's checksum.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Newest {
    number: u32,
    checksum: Option<[u8; 4]>,
}

impl<S: BlockStore> Handler<S> {
    /// A handler that waits for a Hello.
    pub fn new(store: S, beginning: &Beginning<'_>) -> Self {
        let in_use = beginning.in_use.and_then(|(bytes, _)| Block::from_slice(bytes).ok());
        let parameters = beginning.in_use.map(|(bytes, origin)| parameters(bytes, origin));
        let conversation = Conversation {
            hello: Hello::of_this_build(beginning.board),
            limits: beginning.limits,
            store,
            key: beginning.key,
            kept_fault: beginning.fault,
            fault_to_keep: None,
            failures_to_keep: 0,
            nonces: Nonces::new(beginning.nonce_seed),
            nonce: None,
            newest: None,
            was_carried_out: false,
            answer: Vec::new(),
            aside: Vec::new(),
            upload: Upload::default(),
            in_use: in_use.unwrap_or_default(),
            parameters,
            streaming: false,
            heard: false,
            telemetry_dropped: 0,
            requests: 0,
            foreign: 0,
        };
        Self { reader: FrameReader::new(), conversation }
    }

    /// Takes a byte of the line; the frame to send, with its zero, once a request is answered.
    pub fn receive(&mut self, byte: u8, board: &mut impl Desk) -> Option<&[u8]> {
        let dropped = self.reader.dropped();
        let content = self.reader.push(byte)?;
        self.conversation.answer(content, dropped, board)
    }

    /// Bytes of the line were lost: the frame that they were in is void.
    pub fn lose(&mut self) {
        self.reader.lose();
    }

    /// Whether telemetry is to be sent.
    pub fn streaming(&self) -> bool {
        self.conversation.streaming
    }

    /// Whether the host was heard since this was asked last.
    pub fn take_heard(&mut self) -> bool {
        core::mem::take(&mut self.conversation.heard)
    }

    /// Tells how many telemetry records could not be sent since power-on.
    pub fn set_telemetry_dropped(&mut self, dropped: u32) {
        self.conversation.telemetry_dropped = dropped;
    }

    /// Keeps a new fault, or that there is none any more, over a reset. Call it now and then.
    ///
    /// Whether the store did it; if not, the next call tries again.
    pub fn keep_fault(&mut self, board: &impl Desk) -> bool {
        self.conversation.keep_fault(board.standing().fault)
    }

    /// Which parameter block the host is told to be in use.
    pub fn parameters(&self) -> Option<Parameters> {
        self.conversation.parameters
    }

    /// The store.
    pub fn store(&mut self) -> &mut S {
        &mut self.conversation.store
    }
}

impl<S: BlockStore> Conversation<S> {
    /// The answer to a frame's content; none if it is no message of this build.
    fn answer(&mut self, content: &[u8], dropped: u32, board: &mut impl Desk) -> Option<&[u8]> {
        let Ok(message) = ToBoard::read(content) else {
            self.foreign = self.foreign.wrapping_add(1);
            return None;
        };
        let request = match message {
            ToBoard::Hello { .. } => return Some(self.greet()),
            ToBoard::Request(request) => request,
        };
        let newest = Newest { number: request.number, checksum: content.last_chunk().copied() };
        match self.newest {
            None => return Some(self.deny(request.number, Refusal::HelloFirst)),
            Some(Some(last)) if last == newest => {
                self.heard |= self.was_carried_out;
                return Some(&self.answer);
            }
            Some(Some(last)) if last.number >= newest.number => {
                if let Some(order) = request.command.takes_voltage_away() {
                    return Some(self.obey_at_once(request.number, order, board));
                }
                let newest = last.number;
                return Some(self.deny(request.number, Refusal::OldNumber { newest }));
            }
            Some(_) => self.newest = Some(Some(newest)),
        }
        board.refresh();
        let mut piece = [0; PIECE_BYTES];
        let result = self.carry_out(&request, dropped, &mut piece, board);
        self.was_carried_out = result.is_ok();
        self.heard |= self.was_carried_out;
        self.requests = self.requests.wrapping_add(u32::from(result.is_ok()));
        write(&ToHost::Answer(Answer { number: request.number, result }), &mut self.answer);
        Some(&self.answer)
    }

    /// Begins a conversation.
    fn greet(&mut self) -> &[u8] {
        self.nonce = None;
        self.newest = Some(None);
        write(&ToHost::Hello(self.hello), &mut self.answer);
        &self.answer
    }

    /// Takes the voltage away, whoever asks and under whatever number; the answer to the newest
    /// request is still kept.
    fn obey_at_once(&mut self, number: u32, order: Order, board: &mut impl Desk) -> &[u8] {
        let result = board.order(order).map(|()| Reply::Done).map_err(Refusal::from);
        write(&ToHost::Answer(Answer { number, result }), &mut self.aside);
        &self.aside
    }

    /// Refuses a request out of its turn; the answer to the newest one is still kept.
    fn deny(&mut self, number: u32, why: Refusal) -> &[u8] {
        write(&ToHost::Answer(Answer { number, result: Err(why) }), &mut self.aside);
        &self.aside
    }
}

/// Writes a message's frame; every message of the board fits.
fn write(message: &ToHost<'_>, frame: &mut Vec<u8, MAX_FRAME_BYTES>) {
    let mut buffer = [0; MAX_FRAME_BYTES];
    frame.clear();
    let bytes = message.write(&mut buffer).unwrap_or_default();
    // As long as the buffer at most.
    let _ = frame.extend_from_slice(bytes);
}
