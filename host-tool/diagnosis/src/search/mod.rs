//! Every effect on every joint, one after the other.

mod begin;
mod braking;
pub mod candidate;
pub mod candidates;
mod enough;
pub mod finalists;
pub mod found;
mod from_given;
pub mod harmonics;
pub mod independent_rows;
pub mod objection;
pub mod play;
pub mod policy;
pub mod promise;
pub mod refit;
pub mod restart;
pub mod rivals;
mod runner_up;
pub mod selection;
mod starts;
mod wave_rows;
pub mod winner;
pub mod without;
