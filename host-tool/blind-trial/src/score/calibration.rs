//! Whether confidences mean what they say.

use serde::Serialize;

use super::Share;
use crate::outcome::Outcome;

/// Borders of the bins.
const BORDERS: [f64; 7] = [0.0, 0.5, 0.7, 0.8, 0.9, 0.97, 1.0];

/// Confidences that were stated of all causes named, against how often they were right.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Calibration {
    /// Bins in which a confidence fell.
    pub bins: Vec<Bin>,
    /// Mean square of confidence less truth (1 or 0): 0 is perfect, 0.25 a coin's.
    pub brier: Option<f64>,
}

/// Causes named with like probability.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Bin {
    /// Least probability.
    pub from: f64,
    /// Largest.
    pub to: f64,
    /// Mean of those stated.
    pub stated: f64,
    /// How many were right.
    pub right: Share,
}

impl Calibration {
    pub(super) fn of(outcomes: &[Outcome]) -> Self {
        let stated: Vec<(f64, bool)> = outcomes.iter().flat_map(claims).collect();
        let squares = stated.iter().map(|&(p, right)| (p - f64::from(u8::from(right))).powi(2));
        let brier = squares.sum::<f64>() / stated.len() as f64;
        Self {
            bins: BORDERS.windows(2).filter_map(|b| Bin::between(b[0], b[1], &stated)).collect(),
            brier: (!stated.is_empty()).then_some(brier),
        }
    }
}

/// Each cause named: its confidence, and whether it is true.
fn claims(outcome: &Outcome) -> Vec<(f64, bool)> {
    let named = outcome.answer.named().iter();
    named.map(|cause| (cause.confidence, outcome.is_true(cause))).collect()
}

impl Bin {
    /// Of those `stated`, each with whether it was right, from one probability to below another, 1 included; none
    /// where there are none.
    pub fn between(from: f64, to: f64, stated: &[(f64, bool)]) -> Option<Self> {
        let is_inside = |p: f64| p >= from && (p < to || to == 1.0);
        let inside: Vec<&(f64, bool)> = stated.iter().filter(|(p, _)| is_inside(*p)).collect();
        let sum: f64 = inside.iter().map(|(p, _)| p).sum();
        (!inside.is_empty()).then(|| Self {
            from,
            to,
            stated: sum / inside.len() as f64,
            right: inside.iter().fold(Share::default(), |share, (_, right)| share.with(*right)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_border_belongs_to_the_bin_above_and_one_to_the_last() {
        let stated = |p: f64| [(p, true)];
        assert!(Bin::between(0.2, 0.3, &stated(0.3)).is_none());
        assert!(Bin::between(0.3, 0.4, &stated(0.3)).is_some());
        assert!(Bin::between(0.9, 1.0, &stated(1.0)).is_some());
    }
}
