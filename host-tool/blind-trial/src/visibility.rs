//! How much the causes of a case show.

use serde::Serialize;

/// How much the causes of a case show, in noise floors unless it says otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Visibility {
    /// What they add to the true model's residual, on the joint and log where most.
    pub raw: f64,
    /// What is left of that after a refit held by the model given.
    pub left: f64,
    /// How far that refit moved the parameters, in standard deviations of their errors.
    pub moved: f64,
}

impl Visibility {
    /// Whether a diagnosis has a chance: five floors of the true model, and of these two
    /// and a half after the refit, or parameters where no error of 2 % brings them.
    pub fn is_detectable(&self) -> bool {
        self.raw >= 5.0 && (self.left >= 2.5 || self.moved >= 12.0)
    }
}
