//! Who watches over the controller: states, faults, limits.

pub mod fault;

pub use fault::{Fault, FaultRecord, Implausible, State};
