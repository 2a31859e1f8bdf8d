//! The supervisor as the command handler reaches it, in the same thread or across to the tick.

use crate::supervisor::{FaultRecord, Order, OrderError, State, Supervisor, TickCounters};
use crate::{Controller, ParameterBlock};

/// The supervisor, reached from outside the tick.
///
/// What is asked for is done between two ticks, and is done when the call returns.
pub trait SupervisorAccess {
    /// Fetches the present status, where that takes time; called before a request is carried out.
    fn refresh(&mut self) {}
    /// The status, as of the last refresh.
    fn status(&self) -> SupervisorStatus;
    /// Carries an order out, or says why not.
    fn order(&mut self, order: Order) -> Result<(), OrderError>;
    /// Puts a checked block into use; only Disarmed.
    fn replace(&mut self, block: &ParameterBlock) -> Result<(), OrderError>;
}

/// What the supervisor is doing, and what it has counted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SupervisorStatus {
    /// What the supervisor is doing.
    pub state: State,
    /// The first cause, while Faulted.
    pub fault: Option<FaultRecord>,
    /// Whether the counts of each joint are those from the model's zero.
    pub position_known: [bool; 3],
    /// What the ticks have counted.
    pub counters: TickCounters,
}

impl SupervisorAccess for Supervisor {
    fn status(&self) -> SupervisorStatus {
        SupervisorStatus {
            state: self.state(),
            fault: self.fault(),
            position_known: self.is_position_known(),
            counters: *self.counters(),
        }
    }

    fn order(&mut self, order: Order) -> Result<(), OrderError> {
        self.execute(order)
    }

    fn replace(&mut self, block: &ParameterBlock) -> Result<(), OrderError> {
        Self::replace(self, Controller::new(block.clone()))
    }
}
