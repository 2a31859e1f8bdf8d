//! How far a model as given may be off.

use super::PriorCriteria;

/// How far parameters may be off, in parts of themselves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Doubt {
    /// Masses, inertias and what follows from them.
    pub masses: f64,
    /// Coulomb and viscous friction.
    pub friction: f64,
}

impl Doubt {
    /// The same of all.
    pub fn both(relative: f64) -> Self {
        Self { masses: relative, friction: relative }
    }
}

impl PriorCriteria {
    /// The doubt that there is.
    pub fn doubt(&self) -> Doubt {
        Doubt { masses: self.relative, friction: self.relative_friction }
    }

    /// Takes a doubt for what it is, whatever logs show.
    pub fn take(&mut self, relative: f64) {
        (self.relative, self.relative_friction, self.widest) = (relative, relative, relative);
    }
}
