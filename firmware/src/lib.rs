//! The RRR joint controller without its hardware.
//!
//! Everything above the pins: three encoder counts go into [`Controller::tick`],
//! three DAC codes come out, once a millisecond. The boards under `bin/` add
//! pins, timers and a link, and nothing else. The tick computes in `f32` and integers only, so
//! that the host and the Cortex-M4F give the same codes bit for bit.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`controller`] | **the control law** |
//! | [`block`] | the parameter block: model, gains, limits, reference, checked as a whole |
//! | [`compensation`] | what joints do beyond the model, and what makes up for it |
//! | [`reference`] | the motions and voltages that the board plays by itself |
//! | [`velocity`] | the velocity estimate |
//! | [`angle`], [`encoder`], [`dac`] | machine units: where SI begins and ends |
//! | [`store`] | what is kept without power: parameters, the latched fault, the key |
//! | [`lockstep`] | the records exchanged with a simulated robot |
//! | [`ad5754r`] | the converter's frames |
//! | [`frame`], [`checksum`], [`link`] | what goes over the serial line |
//! | [`supervisor`] | states, faults, limits |
#![cfg_attr(not(test), no_std)]
#![forbid(unsafe_code)]

pub mod ad5754r;
pub mod angle;
pub mod block;
pub mod checksum;
pub mod compensation;
pub mod controller;
pub mod dac;
pub mod encoder;
pub mod frame;
pub mod link;
pub mod lockstep;
pub mod mode;
pub mod reference;
pub mod store;
pub mod supervisor;
pub mod velocity;

pub use angle::Angle;
pub use block::{BlockError, Gains, ParameterBlock};
pub use controller::{Controller, TickOutput};
pub use dac::DacCode;
pub use mode::Mode;
