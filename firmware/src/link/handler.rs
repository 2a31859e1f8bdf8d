//! The command handler: bytes of the line in, answers out.
//!
//! Runs outside the tick and never waits for the line. A request is carried out once,
//! however often it comes: the last answer is kept and given again when the same
//! request comes again.

use heapless::Vec;

use super::answer::{
    Answer, BlockRefusal, Counters, Origin, Parameters, Refusal, Reply, Report, StoreRefusal,
};
use super::checked::{CHECKSUM, MAX_FRAME_BYTES};
use super::desk::{BlockStore, Desk};
use super::hello::Hello;
use super::key::{Key, Nonce, Nonces, is_proven};
use super::messages::{ToBoard, ToHost};
use super::request::{Command, PIECE_BYTES, Request, Source};
use super::upload::{Block, Upload};
use crate::block::MAX_BYTES;
use crate::frame::FrameReader;
use crate::supervisor::{FaultRecord, HardLimits, Order, State};
use crate::{BlockError, ParameterBlock};

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
struct Conversation<S> {
    hello: Hello,
    limits: HardLimits,
    store: S,
    key: Option<Key>,
    kept_fault: Option<FaultRecord>,
    nonces: Nonces,
    nonce: Option<Nonce>,
    /// `None` until there was a Hello, then the newest request of this conversation.
    newest: Option<Option<Newest>>,
    /// The answer to it.
    answer: Vec<u8, MAX_FRAME_BYTES>,
    /// An answer to a request out of its turn.
    aside: Vec<u8, MAX_FRAME_BYTES>,
    upload: Upload,
    in_use: Block,
    parameters: Option<Parameters>,
    streaming: bool,
    heard: bool,
    telemetry_dropped: u32,
    requests: u32,
    foreign: u32,
}

/// A request that was answered: its number, and the checksum of its frame's content.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Newest {
    number: u32,
    checksum: u32,
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
            nonces: Nonces::new(beginning.nonce_seed),
            nonce: None,
            newest: None,
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

    /// Whether the block in use still is what was checked.
    pub fn in_use_is_whole(&self) -> bool {
        let whole = |p: Parameters| p.checksum == CHECKSUM.checksum(&self.conversation.in_use);
        self.conversation.parameters.is_none_or(whole)
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
        self.heard = true;
        let request = match message {
            ToBoard::Hello { .. } => return Some(self.greet()),
            ToBoard::Request(request) => request,
        };
        let newest = Newest { number: request.number, checksum: CHECKSUM.checksum(content) };
        match self.newest {
            None => return Some(self.deny(request.number, Refusal::HelloFirst)),
            Some(Some(last)) if last == newest => return Some(&self.answer),
            Some(Some(last)) if last.number >= newest.number => {
                let newest = last.number;
                return Some(self.deny(request.number, Refusal::OldNumber { newest }));
            }
            Some(_) => self.newest = Some(Some(newest)),
        }
        let mut piece = [0; PIECE_BYTES];
        let result = self.carry_out(&request, dropped, &mut piece, board);
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

    /// Refuses a request out of its turn; the answer to the newest one is still kept.
    fn deny(&mut self, number: u32, why: Refusal) -> &[u8] {
        write(&ToHost::Answer(Answer { number, result: Err(why) }), &mut self.aside);
        &self.aside
    }

    /// Whether the request may be carried out as far as the key is concerned.
    fn is_allowed(&self, request: &Request<'_>) -> bool {
        match (&self.key, &self.nonce) {
            (None, _) => true,
            _ if !request.command.needs_proof() => true,
            (Some(_), None) => false,
            (Some(key), Some(nonce)) => is_proven(key, nonce, request),
        }
    }

    fn carry_out<'p>(
        &mut self,
        request: &Request<'_>,
        dropped: u32,
        piece: &'p mut [u8; PIECE_BYTES],
        board: &mut impl Desk,
    ) -> Result<Reply<'p>, Refusal> {
        if !self.is_allowed(request) {
            return Err(Refusal::Proof);
        }
        match request.command {
            Command::Query => return Ok(Reply::Report(self.report(dropped, board))),
            Command::Stream { on } => self.streaming = on,
            Command::Challenge => return Ok(Reply::Challenge { nonce: self.challenge() }),
            Command::UploadBegin { length, checksum } => {
                only_disarmed(board)?;
                self.upload.begin(length, checksum)?;
            }
            Command::UploadPiece { offset, bytes } => self.upload.add(offset, bytes)?,
            Command::Use => return self.put_into_use(Origin::Uploaded, board),
            Command::Commit => return self.put_into_use(Origin::Newest, board),
            Command::Download { source, offset } => return self.download(source, offset, piece),
            Command::Arm => board.order(Order::Arm)?,
            Command::Run { host_timeout_ms } => board.order(self.run(host_timeout_ms))?,
            Command::Stop => board.order(Order::Stop)?,
            Command::Disarm => board.order(Order::Disarm)?,
            Command::ClearFault => self.clear_fault(board)?,
            Command::SetKey { key } => self.set_key(key, board)?,
        }
        Ok(Reply::Done)
    }

    fn report(&self, dropped: u32, board: &impl Desk) -> Report {
        let standing = board.standing();
        Report {
            state: standing.state,
            fault: standing.fault,
            parameters: self.parameters,
            has_key: self.key.is_some(),
            counters: Counters {
                telemetry_dropped: self.telemetry_dropped,
                frames_broken: dropped.wrapping_add(self.foreign),
                requests: self.requests,
                ..standing.counters
            },
        }
    }

    fn challenge(&mut self) -> Nonce {
        let nonce = self.nonces.next_nonce();
        self.nonce = Some(nonce);
        nonce
    }

    /// Checks the upload as a whole; stores it if it is to be the newest; then uses it.
    fn put_into_use<'p>(
        &mut self,
        origin: Origin,
        board: &mut impl Desk,
    ) -> Result<Reply<'p>, Refusal> {
        only_disarmed(board)?;
        let bytes = self.upload.whole()?;
        let block = ParameterBlock::decode(bytes).map_err(BlockRefusal::from)?;
        self.limits.check(&block).map_err(|error| BlockRefusal::from(BlockError::from(error)))?;
        if origin == Origin::Newest {
            self.store.commit(bytes)?;
            read_back(&mut self.store, bytes)?;
        }
        board.replace(&block)?;
        let parameters = parameters(bytes, origin);
        self.parameters = Some(parameters);
        self.in_use = Block::from_slice(bytes).unwrap_or_default();
        Ok(Reply::InUse(parameters))
    }

    fn download<'p>(
        &mut self,
        source: Source,
        offset: u16,
        piece: &'p mut [u8; PIECE_BYTES],
    ) -> Result<Reply<'p>, Refusal> {
        let mut buffer = [0; MAX_BYTES];
        let whole = match source {
            Source::InUse if self.parameters.is_none() => return Err(Refusal::NoParameters),
            Source::InUse => &self.in_use,
            Source::Stored => self.store.load(&mut buffer)?,
        };
        let rest = whole.get(usize::from(offset)..).unwrap_or_default();
        let (piece, _) = piece.split_at_mut(rest.len().min(PIECE_BYTES));
        for (slot, byte) in piece.iter_mut().zip(rest) {
            *slot = *byte;
        }
        let (length, checksum) = (whole.len() as u16, CHECKSUM.checksum(whole));
        Ok(Reply::Piece { length, checksum, bytes: piece })
    }

    fn run(&self, host_timeout_ms: Option<u16>) -> Order {
        let ticks = |ms: u16| (f32::from(ms) * 1e-3 / self.limits.sample_period_s + 0.5) as u32;
        Order::Run { host_timeout_ticks: host_timeout_ms.map(ticks) }
    }

    /// What is kept over a reset is cleared last: a cut in between leaves the fault latched.
    fn clear_fault(&mut self, board: &mut impl Desk) -> Result<(), Refusal> {
        board.order(Order::ClearFault)?;
        match self.keep_fault(None) {
            true => Ok(()),
            false => Err(Refusal::Store(StoreRefusal::Write)),
        }
    }

    fn set_key(&mut self, key: Option<Key>, board: &mut impl Desk) -> Result<(), Refusal> {
        only_disarmed(board)?;
        self.store.keep_key(key.as_ref())?;
        self.key = key;
        self.nonce = None;
        Ok(())
    }

    fn keep_fault(&mut self, fault: Option<FaultRecord>) -> bool {
        if fault == self.kept_fault {
            return true;
        }
        let kept = self.store.keep_fault(fault.as_ref()).is_ok();
        if kept {
            self.kept_fault = fault;
        }
        kept
    }
}

fn only_disarmed(board: &impl Desk) -> Result<(), Refusal> {
    match board.standing().state {
        State::Disarmed => Ok(()),
        state => Err(Refusal::NotNow { state }),
    }
}

/// Has the store show what it has stored; a store that says yes may still be wrong.
fn read_back(store: &mut impl BlockStore, written: &[u8]) -> Result<(), Refusal> {
    let mut buffer = [0; MAX_BYTES];
    match store.load(&mut buffer)? == written {
        true => Ok(()),
        false => Err(Refusal::Store(StoreRefusal::ReadBack)),
    }
}

fn parameters(bytes: &[u8], origin: Origin) -> Parameters {
    Parameters { origin, length: bytes.len() as u16, checksum: CHECKSUM.checksum(bytes) }
}

/// Writes a message's frame; every message of the board fits.
fn write(message: &ToHost<'_>, frame: &mut Vec<u8, MAX_FRAME_BYTES>) {
    let mut buffer = [0; MAX_FRAME_BYTES];
    frame.clear();
    let bytes = message.write(&mut buffer).unwrap_or_default();
    // As long as the buffer at most.
    let _ = frame.extend_from_slice(bytes);
}
