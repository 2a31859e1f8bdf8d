//! The RRR joint controller without its hardware.
//!
//! Three encoder counts go into [`Controller::tick`], three DAC codes come out, once a
//! millisecond. The programs under `bin/` add a board's pins, timers and serial line, and
//! nothing else. The tick computes in `f32` and integers only, so
//! that the host and the Cortex-M4F give the same codes bit for bit.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`controller`] | **the control law** |
//! | [`block`] | the parameter block: model, gains, limits, reference, checked as a whole |
//! | [`compensation`] | feedforward and input inverses for effects that the rigid-body and friction model lacks |
//! | [`reference`] | reference motions and injected voltages |
//! | [`velocity`] | the velocity estimate |
//! | [`angle`], [`encoder`], [`dac`] | conversion between SI and the units of encoder and converter |
//! | [`store`] | non-volatile storage: parameters, the latched fault, the key |
//! | [`lockstep`] | the messages exchanged with a simulated robot |
//! | [`ad5754r`] | the converter's frames |
//! | [`loopback`] | the converter's outputs, measured behind a divider |
//! | [`frame`], [`checksum`], [`link`] | what goes over the serial line |
//! | [`supervisor`] | state machine, fault detection |
#![cfg_attr(not(test), no_std)]
#![forbid(unsafe_code)]

pub mod ad5754r;
pub mod angle;
pub mod block;
pub mod checksum;
pub mod clock_check;
pub mod compensation;
pub mod controller;
pub mod dac;
pub mod encoder;
mod feedforward;
pub mod frame;
mod joint;
pub mod link;
pub mod lockstep;
pub mod loopback;
pub mod mode;
pub mod reference;
mod start_fade;
pub mod store;
pub mod supervisor;
pub mod velocity;

pub use angle::Angle;
pub use block::{BlockError, Gains, ParameterBlock};
pub use controller::{Controller, TickOutput};
pub use dac::DacCode;
pub use mode::Mode;
