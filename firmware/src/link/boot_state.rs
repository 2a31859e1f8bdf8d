//! What a boot finds in the store, and what the board begins with.

use embedded_storage::nor_flash::NorFlash;

use super::answer::Origin;
use super::block_store::{BlockStore, decode_fault};
use super::conversation::HandlerConfig;
use super::handler::Handler;
use super::key::Key;
use super::upload::Block;
use crate::block::{HardLimits, MAX_BYTES};
use crate::store::{Content, Kind, NOTE_BYTES, Source, Store};
use crate::supervisor::{BootReport, FaultRecord, Supervisor};
use crate::{Controller, ParameterBlock};

/// What the board begins with.
#[derive(Clone, Debug)]
pub struct BootState {
    /// The block in force; safe defaults if none is stored.
    pub block: ParameterBlock,
    /// The same, encoded.
    pub encoded: Block,
    /// Where it comes from.
    pub origin: Origin,
    /// Parameters were stored, but none of them can be used.
    pub corrupt: bool,
    /// The latched fault.
    pub fault: Option<FaultRecord>,
    /// The key.
    pub key: Option<Key>,
}

impl BootState {
    /// Reads the store; erases and writes nothing.
    pub fn read<F: NorFlash>(store: &mut Store<F>) -> Self {
        let boot = store.boot();
        let nothing_stored = boot.slots.iter().all(|slot| slot.content == Content::Blank);
        let origin = match boot.source {
            Source::Newest { .. } => Origin::Newest,
            Source::Other { .. } => Origin::Older,
            Source::Defaults => Origin::SafeDefaults,
        };
        Self {
            encoded: encoded(&boot.block),
            block: boot.block,
            origin,
            corrupt: origin == Origin::SafeDefaults && !nothing_stored,
            fault: read_note(store, Kind::Fault, decode_fault),
            key: read_note(store, Kind::Key, |bytes| bytes.try_into().ok()),
        }
    }

    /// The board's end of the conversation.
    ///
    /// `nonce_seed` is from the board's random generator.
    pub fn handler<S: BlockStore>(
        &self,
        store: S,
        board: &str,
        nonce_seed: [u8; 16],
    ) -> Handler<S> {
        let config = HandlerConfig {
            board,
            limits: HardLimits::of_rig(),
            nonce_seed,
            key: self.key,
            fault: self.fault,
            in_use: Some((&self.encoded, self.origin)),
        };
        Handler::new(store, &config)
    }

    /// A supervisor with the parameters; its boot has not ended yet.
    pub fn supervisor(&self) -> Supervisor {
        let mut supervisor = Supervisor::default();
        // Before the end of the boot it takes any.
        let _ = supervisor.replace(Controller::new(self.block.clone()));
        supervisor
    }

    /// What the supervisor must know of the boot, as far as the flash knows.
    pub fn report(&self) -> BootReport {
        BootReport {
            latched: self.fault,
            parameters_corrupt: self.corrupt,
            ..BootReport::default()
        }
    }
}

/// The encoding is unique, so this is what was stored.
fn encoded(block: &ParameterBlock) -> Block {
    let mut buffer = [0; MAX_BYTES];
    let bytes = block.encode(&mut buffer).unwrap_or_default();
    Block::from_slice(bytes).unwrap_or_default()
}

fn read_note<F: NorFlash, T>(
    store: &mut Store<F>,
    kind: Kind,
    read: impl FnOnce(&[u8]) -> Option<T>,
) -> Option<T> {
    let mut buffer = [0; NOTE_BYTES];
    let length = store.read_note(kind, &mut buffer)?;
    read(buffer.get(..length)?)
}
