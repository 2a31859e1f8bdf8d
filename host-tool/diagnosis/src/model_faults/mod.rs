//! Faults of the model as given that are no effects: a joint that counts the other way, two joints
//! exchanged, a home position or lengths that are not the robot's, commands that all act late.
//!
//! They are tried on a part of the train logs, with all parameters held by what is known of them.
//! One that explains nearly all of the gap, and no less than the causes found do, is said in their
//! place: parameters and effects that make up for a wrong length are those of no robot. Lengths that are a few per cent
//! off are no such fault; what they explain as well as an effect of the whole robot does is not that effect's.

mod best;
mod fault;
mod lengths;
mod trials;

pub use best::{Faults, FoundFault};
pub use fault::ModelFault;
pub use lengths::is_by_lengths;
