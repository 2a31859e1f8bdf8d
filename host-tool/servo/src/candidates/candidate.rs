//! An effect with what is fitted of it.

use crate::fit::{Field, Unknown};
use crate::joint::ServoJoint;

/// An effect with what is fitted of it and where the search begins.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// Its name in reports.
    pub effect: &'static str,
    /// Its parameters.
    pub unknowns: Vec<Unknown>,
    /// Values to begin with, one per parameter, for each start.
    pub starts: Vec<Vec<f64>>,
    /// What else is set, to what.
    pub fixed: Vec<(Field, f64)>,
}

impl Candidate {
    /// Nothing else is set.
    pub fn new(effect: &'static str, unknowns: Vec<Unknown>, starts: Vec<Vec<f64>>) -> Self {
        Self { effect, unknowns, starts, fixed: Vec::new() }
    }

    /// Of one parameter, from one start.
    pub fn of_one(effect: &'static str, unknown: Unknown, start: f64) -> Self {
        Self::new(effect, vec![unknown], vec![vec![start]])
    }

    /// All fields that it sets.
    pub fn fields(&self) -> impl Iterator<Item = Field> {
        let fitted = self.unknowns.iter().map(|unknown| unknown.field);
        fitted.chain(self.fixed.iter().map(|(field, _)| *field))
    }

    /// The joint with the effect at a start.
    pub fn start(&self, servo: &ServoJoint, values: &[f64]) -> ServoJoint {
        let mut start = *servo;
        self.fixed.iter().for_each(|(field, value)| field.set(&mut start, *value));
        for (unknown, value) in self.unknowns.iter().zip(values) {
            unknown.field.set(&mut start, *value);
        }
        start
    }
}

/// An unknown between bounds: ten of its sizes are as likely as not, a tenth of one makes a difference.
pub fn free(field: Field, bounds: [f64; 2], size: f64) -> Unknown {
    Unknown::between(field, bounds, (0.0, 10.0 * size), 0.1 * size)
}
