//! The numbers that commands are linear in: where each stands.

use model::chain::LINK_PARAMETERS;

/// Friction's numbers per joint: Coulomb level, viscous coefficient, and terms beyond.
pub const OWN: usize = FRICTION + TERMS;

/// Those of them that every joint's friction has, the first.
pub const FRICTION: usize = 2;

/// Those that a command may have beyond, after them.
pub const TERMS: usize = 4;

/// Link parameters of n joints, then per joint Coulomb, viscous, terms beyond.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Number of joints n.
    pub joints: usize,
}

impl Layout {
    /// How many link parameters there are, rotors included.
    pub fn links(self) -> usize {
        LINK_PARAMETERS * self.joints
    }

    /// How many numbers there are in all.
    pub fn all(self) -> usize {
        self.links() + OWN * self.joints
    }

    /// Numbers of one joint's rows: all links and its own friction.
    pub fn of_row(self) -> usize {
        self.links() + OWN
    }

    /// Where the first of a joint's own numbers stands.
    pub fn own(self, joint: usize) -> usize {
        self.links() + OWN * joint
    }

    /// What a joint's rows multiply, out of all numbers.
    pub fn row_numbers(self, joint: usize, all: &[f64]) -> Vec<f64> {
        let own = &all[self.own(joint)..][..OWN];
        all[..self.links()].iter().chain(own).copied().collect()
    }
}
