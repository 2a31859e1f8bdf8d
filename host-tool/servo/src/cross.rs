//! Cross-validation over whole logs.

use rayon::prelude::*;

use crate::fit::{Fitted, Problem, errors, fit, robust, squares};
use crate::joint::ServoJoint;
use crate::judged::Judged;

/// What a fitted joint leaves of each log when that log's fold is left out of the fit.
#[derive(Clone, Debug, PartialEq)]
pub struct LeftOut {
    /// By log: far blocks by their logarithm [rad^2].
    pub robust: Vec<f64>,
    /// By log: sum of squares [rad^2].
    pub squares: Vec<f64>,
    /// By log: rows that count.
    pub rows: Vec<usize>,
}

impl LeftOut {
    /// What a fit leaves of the logs that it was made on.
    pub fn of_fit(fitted: &Fitted, problem: &Problem) -> Self {
        let left = |log: &&Judged| left_of(&fitted.servo, log, problem);
        Self::of(problem.logs.par_iter().map(left).collect())
    }

    fn of(found: Vec<(f64, f64, usize)>) -> Self {
        Self {
            robust: found.iter().map(|log| log.0).collect(),
            squares: found.iter().map(|log| log.1).collect(),
            rows: found.iter().map(|log| log.2).collect(),
        }
    }
}

fn left_of(servo: &ServoJoint, log: &Judged, problem: &Problem) -> (f64, f64, usize) {
    let left = errors(servo, log, problem.joint, problem.step_s);
    let (sum, rows) = squares(&left, log, problem.joint);
    (robust(&left, log, problem.joint, problem.scale), sum, rows)
}

/// Leaves every fold of logs out in turn, log k being of fold k modulo `folds`, and fits to the
/// others, from the fit to all.
pub fn cross_validate(problem: &Problem, fitted: &Fitted, folds: usize) -> LeftOut {
    let of = |fold: usize| {
        let is_out = |k: usize| k % folds == fold;
        let logs: Vec<&Judged> =
            problem.logs.iter().enumerate().filter(|(k, _)| !is_out(*k)).map(|(_, l)| *l).collect();
        let servo = match logs.is_empty() {
            true => fitted.servo,
            false => fit(&Problem { logs: &logs, iterations: 2, ..*problem }, &fitted.servo).servo,
        };
        let out = problem.logs.iter().enumerate().filter(|(k, _)| is_out(*k));
        out.map(|(k, log)| (k, left_of(&servo, log, problem))).collect::<Vec<_>>()
    };
    let mut found: Vec<_> = (0..folds).into_par_iter().flat_map(of).collect();
    found.sort_by_key(|log| log.0);
    LeftOut::of(found.into_iter().map(|log| log.1).collect())
}

/// How much less a model leaves than another, log by log.
#[derive(Clone, Debug, PartialEq)]
pub struct Gain {
    /// Part of what the other leaves.
    pub part: f64,
    /// By how many deviations, from log to log, it is above zero: of the squares, or of each log's part
    /// of its own, whichever is more. The first lets a log that leaves little say little, the second does
    /// not let one that leaves much outvote the others.
    pub certainty: f64,
    /// 1 - rms / rms of the other, in each half of the logs (robust). Two pieces of one log are of the same
    /// half: what acts as a log begins is not in the second one.
    pub halves: [f64; 2],
}

impl Gain {
    /// Of a model over another.
    pub fn of(model: &LeftOut, other: &LeftOut) -> Self {
        let differences: Vec<f64> =
            other.robust.iter().zip(&model.robust).map(|(o, m)| o - m).collect();
        let total: f64 = other.robust.iter().sum();
        let sum: f64 = differences.iter().sum();
        let parts =
            differences.iter().zip(&other.robust).map(|(d, o)| d / o.max(f64::MIN_POSITIVE));
        let half = |side: usize| {
            // Two logs or pieces are a half each.
            let of_half = if other.robust.len() > 2 { 2 } else { 1 };
            let is_in = |k: &usize| (k / of_half) % 2 == side;
            let of = |left: &[f64]| (0..left.len()).filter(is_in).map(|k| left[k]).sum::<f64>();
            1.0 - (of(&model.robust) / of(&other.robust).max(f64::MIN_POSITIVE)).sqrt()
        };
        Self {
            part: sum / total.max(f64::MIN_POSITIVE),
            certainty: deviations(differences.iter().copied()).max(deviations(parts)),
            halves: [half(0), half(1)],
        }
    }
}

/// By how many deviations the sum of differences is above zero, each of them as uncertain as it is large.
fn deviations(differences: impl Iterator<Item = f64>) -> f64 {
    let (sum, squares) =
        differences.fold((0.0, 0.0), |(sum, squares), d| (sum + d, squares + d * d));
    sum / squares.sqrt().max(f64::MIN_POSITIVE)
}
