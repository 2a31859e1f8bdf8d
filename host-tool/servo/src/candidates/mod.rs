//! Effects on one joint that are tried over the refitted base, by what they change.

mod candidate;
mod drive;
mod friction;
mod reading;
mod typical;

use crate::base::Base;

pub use candidate::{Candidate, free};
pub use friction::{MOST_LOST, by_motor_torque, over_speed};
pub use typical::Typical;

/// All effects that are tried on a joint; `cogging` lists orders per turn.
pub fn of_joint(base: &Base, typical: &Typical, cogging: &[f64]) -> Vec<Candidate> {
    let mut all = drive::effects(base, typical, cogging);
    all.extend(friction::effects(base));
    all.extend(reading::effects(typical));
    all
}
