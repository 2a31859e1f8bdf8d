//! What the command handler works on: the supervisor and the store, wherever they are.

use super::answer::{BlockRefusal, Counters, Refusal, StoreRefusal};
use super::key::Key;
use crate::block::MAX_BYTES;
use crate::supervisor::{Denied, FaultRecord, Order, State, Supervisor};
use crate::{BlockError, Controller, ParameterBlock};

/// The supervisor, as somebody outside the tick reaches it.
///
/// What is asked for is done between two ticks, and is done when the call returns.
pub trait Desk {
    /// Looks how things stand, where that takes time; called before a request is carried out.
    fn refresh(&mut self) {}
    /// How things stand.
    fn standing(&self) -> Standing;
    /// Carries an order out, or says why not.
    fn order(&mut self, order: Order) -> Result<(), Denied>;
    /// Puts a checked block into use; only Disarmed.
    fn replace(&mut self, block: &ParameterBlock) -> Result<(), Denied>;
}

/// How things stand.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Standing {
    /// What the supervisor is doing.
    pub state: State,
    /// The first cause, while Faulted.
    pub fault: Option<FaultRecord>,
    /// Whether the counts of each joint are those from the model's zero.
    pub position_known: [bool; 3],
    /// What the ticks have counted; what the link counts is zero here.
    pub counters: Counters,
}

impl Desk for Supervisor {
    fn standing(&self) -> Standing {
        Standing {
            state: self.state(),
            fault: self.fault(),
            position_known: self.is_position_known(),
            counters: *self.counters(),
        }
    }

    fn order(&mut self, order: Order) -> Result<(), Denied> {
        self.obey(order)
    }

    fn replace(&mut self, block: &ParameterBlock) -> Result<(), Denied> {
        Self::replace(self, Controller::new(block.clone()))
    }
}

/// What the board keeps without power.
pub trait BlockStore {
    /// Stores an encoded block beside the newest one, reads it back, then makes it the newest.
    fn commit(&mut self, encoded: &[u8]) -> Result<(), StoreRefusal>;
    /// Copies the newest valid block into `buffer`, returns its bytes.
    fn load<'b>(&mut self, buffer: &'b mut [u8; MAX_BYTES]) -> Result<&'b [u8], StoreRefusal>;
    /// Keeps the latched fault over a reset; `None`: there is none any more.
    fn keep_fault(&mut self, fault: Option<&FaultRecord>) -> Result<(), StoreRefusal>;
    /// Keeps the key; `None`: there is none any more.
    fn keep_key(&mut self, key: Option<&Key>) -> Result<(), StoreRefusal>;
}

impl From<Denied> for Refusal {
    fn from(denied: Denied) -> Self {
        match denied {
            Denied::NotNow { state } => Self::NotNow { state },
            Denied::NoParameters => Self::NoParameters,
            Denied::Implausible { joint, why } => Self::Implausible { joint, why },
            Denied::FarFromStart { joint, distance_rad } => {
                Self::FarFromStart { joint, distance_rad }
            }
            Denied::FaultPersists => Self::FaultPersists,
        }
    }
}

impl From<StoreRefusal> for Refusal {
    fn from(why: StoreRefusal) -> Self {
        Self::Store(why)
    }
}

impl From<BlockError> for BlockRefusal {
    fn from(error: BlockError) -> Self {
        match error {
            BlockError::Length { .. } => Self::Length,
            BlockError::Version { found } => Self::Version { found },
            BlockError::Checksum => Self::Checksum,
            BlockError::Layout => Self::Layout,
            BlockError::Parameter(error) => Self::Value {
                name: beginning(error.name),
                joint: error.joint,
                value: error.value as f32,
                must: beginning(error.must),
            },
        }
    }
}

/// As much of a text as there is room for.
fn beginning<const N: usize>(text: &str) -> heapless::String<N> {
    let mut beginning = heapless::String::new();
    // The names are ASCII and shorter; one that is not ends early.
    let _ = text.chars().try_for_each(|letter| beginning.push(letter));
    beginning
}
