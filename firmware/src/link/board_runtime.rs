//! Supervisor, handler and outbox in one thread, for boards that poll their line.

use embedded_storage::nor_flash::NorFlash;

use super::block_store::BlockStore;
use super::boot_state::BootState;
use super::checked::MAX_FRAME_BYTES;
use super::handler::Handler;
use super::messages::ToHost;
use super::outbox::Outbox;
use super::telemetry::Telemetry;
use crate::store::Store;
use crate::supervisor::{BootReport, Health, ParameterWatch, Supervisor, TickRecord};

/// Room for what waits to be sent [bytes].
const OUTBOX_BYTES: usize = 2048;

/// A board from the line to the codes.
#[derive(Debug)]
pub struct BoardRuntime<S> {
    /// The controller under supervision.
    pub supervisor: Supervisor,
    /// The board's end of the conversation.
    pub handler: Handler<S>,
    outbox: Outbox<OUTBOX_BYTES>,
    answers_lost: u32,
    parameter_watch: ParameterWatch,
    parameters_corrupt: bool,
}

impl<F: NorFlash> BoardRuntime<Store<F>> {
    /// Boots with what the flash holds, which is returned too.
    ///
    /// `position_lost`: the encoders count from zero, wherever the arm is.
    pub fn boot(
        mut store: Store<F>,
        board: &str,
        nonce_seed: [u8; 16],
        position_lost: bool,
    ) -> (Self, BootState) {
        let boot_state = BootState::read(&mut store);
        let mut supervisor = boot_state.supervisor();
        supervisor.booted(BootReport { position_lost, ..boot_state.report() });
        (Self::new(supervisor, boot_state.handler(store, board, nonce_seed)), boot_state)
    }
}

impl<S: BlockStore> BoardRuntime<S> {
    /// A board that has booted.
    pub fn new(supervisor: Supervisor, handler: Handler<S>) -> Self {
        Self {
            supervisor,
            handler,
            outbox: Outbox::new(),
            answers_lost: 0,
            parameter_watch: ParameterWatch::default(),
            parameters_corrupt: false,
        }
    }

    /// What the tick must know; the board adds what it knows itself.
    pub fn health(&mut self) -> Health {
        Health {
            host_heard: self.handler.take_heard(),
            parameters_corrupt: self.parameters_corrupt,
            ..Health::default()
        }
    }

    /// After a tick: sends its record if telemetry is on, stores a new fault, prepares the next.
    pub fn after_tick(&mut self, record: &TickRecord) {
        self.handler.set_telemetry_dropped(self.outbox.dropped());
        if self.handler.streaming() {
            let mut buffer = [0; MAX_FRAME_BYTES];
            let dropped = self.outbox.dropped();
            let message = ToHost::Telemetry(Telemetry::new(record, dropped));
            self.outbox.push_telemetry(message.write(&mut buffer).unwrap_or_default());
        }
        self.handler.store_fault(&self.supervisor);
        if ParameterWatch::is_due(record.tick) {
            self.parameters_corrupt = self.parameter_watch.check(&self.supervisor);
        }
        self.supervisor.prepare();
    }

    /// Takes a byte of the line; an answer goes to the outbox.
    pub fn receive(&mut self, byte: u8) {
        let Some(frame) = self.handler.receive(byte, &mut self.supervisor) else { return };
        // A host that asks more than it reads must ask again.
        let lost = !self.outbox.push_answer(frame);
        self.answers_lost = self.answers_lost.wrapping_add(u32::from(lost));
    }

    /// The next byte for the line.
    pub fn send(&mut self) -> Option<u8> {
        self.outbox.pop()
    }
}
