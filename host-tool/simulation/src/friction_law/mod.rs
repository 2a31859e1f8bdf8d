//! Laws of friction for the simulated robot, one file each.
//!
//! All use the joint's own alpha0, alpha1 and alpha2, so that a LuGre model is about right in
//! sliding; they differ where a joint starts, stops and reverses.

mod dahl;
mod law;
mod lugre;
mod maxwell_slip;
mod regularised_coulomb;
mod soft_constraint;
mod stribeck_lag;
mod warming;

pub use dahl::Dahl;
pub use law::FrictionLaw;
pub use lugre::LuGre;
pub use maxwell_slip::MaxwellSlip;
pub use regularised_coulomb::{RegularisedCoulomb, Slope};
pub use soft_constraint::SoftConstraint;
pub use stribeck_lag::StribeckLag;
pub use warming::{Warming, Warmth};

#[cfg(test)]
mod tests;
