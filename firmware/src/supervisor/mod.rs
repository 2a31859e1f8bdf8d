//! The supervisor of the controller: its state machine and its fault detection.
//!
//! | from | to | by |
//! | --- | --- | --- |
//! | Boot | Disarmed | [`Supervisor::booted`] without a cause for a fault |
//! | Disarmed | Armed | [`Order::Arm`], if all estimates are plausible |
//! | Armed | Running | [`Order::Run`], if every joint is where its reference begins |
//! | Running | Armed | [`Order::Stop`] |
//! | Armed, Running | Disarmed | [`Order::Disarm`] |
//! | Running | Stopping | a fault whose [`StopCategory`] is a controlled stop |
//! | Stopping | Faulted | rest, and a second of holding; or another fault |
//! | any | Faulted | any other fault, see [`Fault`] |
//! | Faulted | Disarmed | [`Order::ClearFault`], and nothing else |
//!
//! The codes are zero in every state but Running and Stopping, and in the very tick that finds a
//! fault, unless it is braked to rest first.
//! Orders and new parameters come between ticks, so they take effect at a tick's
//! boundary, all at once.

mod counters;
mod display;
pub mod fault;
mod health;
mod heat_monitor;
mod home;
mod joint_limits;
mod joint_monitor;
mod latch;
mod measured_outputs;
mod monitored_controller;
mod orders;
mod output_monitor;
mod parameter_watch;
mod range_monitor;
mod stall;
mod state_machine;
mod stop_category;
mod tick;
mod tick_record;

pub use counters::TickCounters;
pub use fault::{Fault, FaultRecord, Implausible, State};
pub use health::{BootReport, Health};
pub use latch::{Kept, Latch};
pub use orders::{Order, OrderError};
pub use parameter_watch::{CHECK_EVERY_TICKS, ParameterWatch};
pub use state_machine::Supervisor;
pub use stop_category::{DriveOutputs, StopCategory};
pub use tick_record::TickRecord;
