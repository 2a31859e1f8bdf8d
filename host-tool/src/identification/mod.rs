//! The paper's identification procedure, step by step, and past it.
//!
//! | module | step |
//! | --- | --- |
//! | [`campaign`] | the recorded experiments, ready for use |
//! | [`estimate`] | a value with its uncertainty |

pub mod campaign;
pub mod estimate;

pub use campaign::{Campaign, Trace};
pub use estimate::{Estimate, StepError};
