//! The rig: effects that its model lacks, which of them its board compensates for, the experiments
//! that it can play, and the parameter block that goes onto the board.
#![forbid(unsafe_code)]

pub mod board_tables;
pub mod compensation;
pub mod designed_excitation;
pub mod effects;
pub mod joints;
pub mod plan;
pub mod plant;
pub mod range;
pub mod recipe;
mod rig;

pub use plan::Plan;
pub use plant::Plant;
pub use recipe::Recipe;
pub use rig::Rig;
