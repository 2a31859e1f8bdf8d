//! Intervals of fitted parameters, from the normal equations.

use crate::fit::{Field, Fitted, Normal, Unknown};
use crate::outcome::Outcome;
use crate::verdict::JointCause;

/// 95 % intervals of a fit's unknowns.
pub fn of_fit(unknowns: &[Unknown], fitted: &Fitted) -> Vec<(Field, [f64; 2])> {
    let zero = Normal::zero(unknowns.len());
    let sum = fitted.normals.iter().fold(zero, Normal::plus);
    let mut matrix = sum.matrix / fitted.square_of_one;
    for (k, unknown) in unknowns.iter().enumerate() {
        matrix[(k, k)] += unknown.prior.1.powi(-2);
    }
    let Some(covariance) = matrix.cholesky().map(|factor| factor.inverse()) else {
        return Vec::new();
    };
    let of = |(k, unknown): (usize, &Unknown)| {
        let half = 1.96 * covariance[(k, k)].max(0.0).sqrt();
        let here = unknown.coordinate(&fitted.servo);
        let value = |x: f64| if unknown.is_log { x.exp() } else { x };
        (unknown.field, [value(here - half), value(here + half)])
    };
    unknowns.iter().enumerate().map(of).collect()
}

/// Those of a cause's parameters; none of what joints of a type share.
pub fn intervals(outcome: &Outcome, cause: &JointCause) -> Vec<(Field, [f64; 2])> {
    let selected = &outcome.selected[cause.joint].model;
    let own = selected.effects.iter().any(|effect| effect.effect == cause.effect);
    if own { of_fit(&selected.unknowns, &selected.fitted) } else { Vec::new() }
}
