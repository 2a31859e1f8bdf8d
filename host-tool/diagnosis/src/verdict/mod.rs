//! What the search amounts to.

pub mod alone;
pub mod blocks;
pub mod confirmed;
pub mod decision;
pub mod detectable;
pub mod elimination;
pub mod held;
pub mod judged;
pub mod judgement;
pub mod misfit;
mod own_action;
pub mod told;
mod told_values;
mod wave_of_friction;
pub mod worth;
