//! What each command does, once it is its turn.

use super::answer::{BlockRefusal, Counters, Origin, Refusal, Reply, Report, StoreRefusal};
use super::block_store::BlockStore;
use super::conversation::{Conversation, parameters};
use super::key::{Key, Nonce, is_proven};
use super::request::{Command, PIECE_BYTES, Request, Source};
use super::supervisor_access::SupervisorAccess;
use super::upload::Block;
use crate::block::MAX_BYTES;
use crate::checksum::CRC_32C;
use crate::supervisor::{FaultRecord, Order, State};
use crate::{BlockError, ParameterBlock};

/// How often the store is asked to take the same fault.
const MAX_STORE_ATTEMPTS: u8 = 3;

impl<S: BlockStore> Conversation<S> {
    /// Carries a request out, or says why not; a piece of a block is put into `piece`.
    pub(super) fn execute<'p>(
        &mut self,
        request: &Request<'_>,
        dropped: u32,
        piece: &'p mut [u8; PIECE_BYTES],
        board: &mut impl SupervisorAccess,
    ) -> Result<Reply<'p>, Refusal> {
        if !self.is_allowed(request) {
            return Err(Refusal::Proof);
        }
        match request.command {
            Command::Query => return Ok(Reply::Report(self.report(dropped, board))),
            Command::Stream { on } => self.streaming = on,
            Command::Challenge => return Ok(Reply::Challenge { nonce: self.challenge() }),
            Command::UploadBegin { length, checksum } => {
                require_disarmed(board)?;
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
            Command::Home { position } => board.order(Order::Home { position })?,
            Command::SetKey { key } => self.set_key(key, board)?,
        }
        Ok(Reply::Done)
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

    fn report(&self, dropped: u32, board: &impl SupervisorAccess) -> Report {
        let status = board.status();
        let ticks = status.counters;
        Report {
            state: status.state,
            fault: status.fault,
            position_known: status.position_known,
            parameters: self.parameters,
            has_key: self.key.is_some(),
            counters: Counters {
                telemetry_dropped: self.telemetry_dropped,
                frames_broken: dropped.wrapping_add(self.foreign_frames),
                requests: self.requests,
                ticks: ticks.ticks,
                overruns: ticks.overruns,
                longest_tick_tenth_us: ticks.longest_tick_tenth_us,
                saturated: ticks.saturated,
            },
        }
    }

    fn challenge(&mut self) -> Nonce {
        let nonce = self.nonces.next_nonce();
        self.nonce = Some(nonce);
        nonce
    }

    /// Checks the complete upload, stores it on a commit, and puts it into use.
    fn put_into_use<'p>(
        &mut self,
        origin: Origin,
        board: &mut impl SupervisorAccess,
    ) -> Result<Reply<'p>, Refusal> {
        require_disarmed(board)?;
        let bytes = self.upload.complete()?;
        let block = ParameterBlock::decode(bytes).map_err(BlockRefusal::from)?;
        self.limits.check(&block).map_err(|error| BlockRefusal::from(BlockError::from(error)))?;
        if origin == Origin::Newest {
            self.store.commit(bytes)?;
            read_back(&mut self.store, bytes)?;
        }
        board.replace(&block).map_err(|error| match origin {
            Origin::Newest => Refusal::StoredNotInUse,
            _ => error.into(),
        })?;
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
        let (length, checksum) = (whole.len() as u16, CRC_32C.checksum(whole));
        Ok(Reply::Piece { length, checksum, bytes: piece })
    }

    /// The order to run: whatever the host asks for, it is never silent for longer than the rig allows.
    fn run(&self, host_timeout_ms: Option<u16>) -> Order {
        let ticks = |seconds: f32| (seconds / self.limits.sample_period_s + 0.5) as u32;
        let longest = ticks(self.limits.host_silence_s);
        let asked = host_timeout_ms.map_or(longest, |ms| ticks(f32::from(ms) * 1e-3));
        Order::Run { host_timeout_ticks: Some(asked.min(longest)) }
    }

    /// The stored fault is cleared last: a power cut in between leaves the fault latched.
    fn clear_fault(&mut self, board: &mut impl SupervisorAccess) -> Result<(), Refusal> {
        board.order(Order::ClearFault)?;
        match self.store_fault(None) {
            true => Ok(()),
            false => Err(Refusal::Store(StoreRefusal::Write)),
        }
    }

    fn set_key(
        &mut self,
        key: Option<Key>,
        board: &mut impl SupervisorAccess,
    ) -> Result<(), Refusal> {
        require_disarmed(board)?;
        self.store.store_key(key.as_ref())?;
        self.key = key;
        self.nonce = None;
        Ok(())
    }

    /// Stores a fault, or that there is none, over a reset; whether the store did it.
    pub(super) fn store_fault(&mut self, fault: Option<FaultRecord>) -> bool {
        if fault == self.stored_fault {
            return true;
        }
        if fault != self.fault_to_store {
            (self.fault_to_store, self.store_failures) = (fault, 0);
        }
        // A flash that does not take it would be worn out by trying for ever.
        if self.store_failures == MAX_STORE_ATTEMPTS {
            return false;
        }
        let stored = self.store.store_fault(fault.as_ref()).is_ok();
        if stored {
            self.stored_fault = fault;
        } else {
            self.store_failures += 1;
        }
        stored
    }
}

fn require_disarmed(board: &impl SupervisorAccess) -> Result<(), Refusal> {
    match board.status().state {
        State::Disarmed => Ok(()),
        state => Err(Refusal::NotNow { state }),
    }
}

/// Compares what the store holds with what was written.
fn read_back(store: &mut impl BlockStore, written: &[u8]) -> Result<(), Refusal> {
    let mut buffer = [0; MAX_BYTES];
    match store.load(&mut buffer)? == written {
        true => Ok(()),
        false => Err(Refusal::Store(StoreRefusal::ReadBack)),
    }
}
