//! How much likelier one effect is than another: what both leave, how many rows that is, and among how
//! many one chose.

use crate::candidates::Candidate;
use crate::cogging_orders::HIGHEST;
use crate::fit::{Problem, errors};
use crate::joint::ServoJoint;

/// Logarithm of the likelihood that an effect gains, less what its parameters and its choice cost: half the
/// logarithm of the rows for each parameter (Schwarz's criterion).
///
/// `ratio` is what is left without the effect by what is left with it, `rows` how many are independent.
pub fn evidence(effect: &Candidate, ratio: f64, rows: f64) -> f64 {
    // Each order of cogging that is looked at is a hypothesis of its own.
    let choices = if effect.effect == "cogging" { HIGHEST as f64 } else { 1.0 };
    let count = effect.unknowns.len() as f64;
    0.5 * rows * ratio.max(f64::MIN_POSITIVE).ln() - 0.5 * count * rows.ln() - choices.ln()
}

/// How many rows say as much as one independent row: 1 + 2 sum of the correlations of what is left, over
/// rows up to [`Problem::rows_in_one`] apart, and no more than that.
pub fn rows_in_one(problem: &Problem, servo: &ServoJoint) -> f64 {
    let most = problem.rows_in_one as usize;
    let mut sums = vec![0.0; most + 1];
    for log in problem.logs {
        let left = errors(servo, log, problem.joint, problem.step_s);
        let counts = &log.counts[problem.joint];
        for (apart, sum) in sums.iter_mut().enumerate() {
            let pairs = (apart..left.len()).filter(|row| counts[*row] && counts[row - apart]);
            *sum += pairs.map(|row| left[row] * left[row - apart]).sum::<f64>();
        }
    }
    let correlated: f64 = sums[1..].iter().map(|sum| sum / sums[0].max(f64::MIN_POSITIVE)).sum();
    (1.0 + 2.0 * correlated).clamp(1.0, problem.rows_in_one)
}
