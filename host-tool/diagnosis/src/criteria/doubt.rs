//! How far a model as given may be off.

use super::PriorCriteria;

/// How far parameters may be off, in parts of themselves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Doubt {
    /// Masses, inertias and what follows from them.
    pub masses: f64,
    /// Friction's parameters.
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

    /// The widest that it may become: no narrower than it is.
    pub fn widest_doubt(&self) -> Doubt {
        let Doubt { masses, friction } = self.doubt();
        Doubt { masses: masses.max(self.widest), friction: friction.max(self.widest) }
    }

    /// Holds all parameters to one doubt, whatever logs show.
    pub fn hold_at(&mut self, relative: f64) {
        (self.relative, self.relative_friction, self.widest) = (relative, relative, relative);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_doubt_that_is_held_is_that_of_all_parameters() {
        let mut prior = PriorCriteria::default();
        prior.hold_at(0.2);
        assert_eq!((prior.doubt(), prior.widest_doubt()), (Doubt::both(0.2), Doubt::both(0.2)));
    }

    #[test]
    fn no_doubt_becomes_narrower() {
        let prior = PriorCriteria { relative_friction: 0.5, ..Default::default() };
        assert_eq!(prior.widest_doubt(), Doubt { masses: prior.widest, friction: 0.5 });
    }
}
