//! Supervisors in the states that tests begin from.

use firmware::reference::Reference;
use firmware::supervisor::{BootReport, Health, Order, Supervisor};
use firmware::{Controller, Mode, ParameterBlock};

use super::block;

/// A run whose host may be silent.
pub const RUN: Order = Order::Run { host_timeout_ticks: None };

/// All joints hold zero, where their encoders are.
pub fn holding(mode: Mode) -> ParameterBlock {
    ParameterBlock { reference: Reference::hold([0.0; 3]), ..block(mode) }
}

/// At 0 V, its controller taken.
pub fn disarmed(block: ParameterBlock) -> Supervisor {
    let mut supervisor = Supervisor::default();
    supervisor.replace(Controller::new(block)).unwrap();
    supervisor.booted(BootReport::default());
    supervisor
}

/// A supervisor that has stood still long enough, with the counts that it stood at.
pub fn armed(block: ParameterBlock) -> Supervisor {
    let mut supervisor = disarmed(block);
    for _ in 0..200 {
        supervisor.tick(&[0; 3], Health::default());
    }
    supervisor.execute(Order::Arm).unwrap();
    supervisor
}
