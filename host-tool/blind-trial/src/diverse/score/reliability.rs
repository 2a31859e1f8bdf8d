//! Whether probabilities mean what they say, and what is risked by believing the surest.

use serde::Serialize;

use crate::diverse::outcome::DiverseOutcome;
use crate::score::{Bin, Share};

/// Bins of equal width.
const BINS: usize = 10;
/// Where on the coverage the risk is told.
const COVERAGES: [f64; 8] = [0.1, 0.25, 0.5, 0.7, 0.8, 0.9, 0.95, 1.0];

/// Probabilities of all names given, against how often they were right.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reliability {
    /// Ten bins; those without a name are left out.
    pub bins: Vec<Bin>,
    /// Mean distance between stated and true, weighted by names: the expected calibration error.
    pub error: Option<f64>,
    /// Mean square of the probability less 1 or 0.
    pub brier: Option<f64>,
    /// What is wrong among the surest names.
    pub risk: Vec<Risk>,
}

/// What is wrong among the surest names.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Risk {
    /// Which part of all names is believed.
    pub coverage: f64,
    /// The least probability among them.
    pub least: f64,
    /// How many of them are wrong.
    pub wrong: Share,
}

impl Reliability {
    pub(super) fn of(outcomes: &[DiverseOutcome]) -> Self {
        let claims = |o: &DiverseOutcome| {
            o.claims.iter().map(|c| (c.probability.clamp(0.0, 1.0), o.is_true(c))).collect()
        };
        let mut stated: Vec<(f64, bool)> =
            outcomes.iter().flat_map(|o| -> Vec<_> { claims(o) }).collect();
        stated.sort_by(|a, b| b.0.total_cmp(&a.0));
        let border = |k: usize| k as f64 / BINS as f64;
        let bin = |k: usize| Bin::between(border(k), border(k + 1), &stated);
        let bins: Vec<Bin> = (0..BINS).filter_map(bin).collect();
        let part = |sum: f64| (!stated.is_empty()).then(|| sum / stated.len() as f64);
        let squares = stated.iter().map(|&(p, right)| (p - f64::from(u8::from(right))).powi(2));
        Self {
            error: part(bins.iter().map(distance).sum()),
            brier: part(squares.sum()),
            risk: COVERAGES.iter().filter_map(|&c| Risk::of(c, &stated)).collect(),
            bins,
        }
    }
}

/// |stated - right|, times the number of names.
fn distance(bin: &Bin) -> f64 {
    bin.right.of as f64 * (bin.stated - bin.right.part().unwrap_or_default()).abs()
}

impl Risk {
    /// `stated` with the surest first.
    fn of(coverage: f64, stated: &[(f64, bool)]) -> Option<Self> {
        let count = (coverage * stated.len() as f64).round() as usize;
        let (least, _) = stated.get(count.checked_sub(1)?)?;
        let wrong = stated[..count].iter().fold(Share::default(), |s, (_, right)| s.with(!right));
        Some(Self { coverage, least: *least, wrong })
    }
}
