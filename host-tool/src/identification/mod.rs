//! The paper's identification procedure, step by step, and past it.
//!
//! | module | step |
//! | --- | --- |
//! | [`campaign`] | the recorded experiments, ready for use |
//! | [`estimate`] | a value with its uncertainty |
//! | [`one_joint`] | what the steps on one joint share, and rigs that have but one |
//! | [`static_friction`] | static friction from constant-velocity runs, eq. (10) |

pub mod campaign;
pub mod estimate;
pub mod one_joint;
pub mod presliding;
pub mod static_friction;

pub use campaign::{Campaign, Trace};
pub use estimate::{Estimate, StepError};
