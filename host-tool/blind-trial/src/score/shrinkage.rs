//! How much of the gap that can be closed was closed.

use serde::Serialize;

use super::median::median;
use crate::case::Kind;
use crate::outcome::Outcome;

/// Gaps closed on the logs held out, over all joints.
///
/// Of a case with effects of the catalogue: (refitted - with effects) / (refitted - ceiling),
/// all rms of the command. The ceiling is what the same diagnosis leaves of the same robot
/// without the effects, where that was asked for, else the noise floor that the diagnosis
/// itself reports. Cases whose refitted gap is within a tenth of the ceiling are left out:
/// a payload, say, is in the refitted model whole.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Shrinkage {
    /// Cases that count.
    pub cases: usize,
    /// Whether the ceilings are the diagnosis' own noise floors.
    pub by_noise_floor: bool,
    /// The middle share.
    pub median: Option<f64>,
    /// The mean share, each cut to between 0 and 1.
    pub mean: Option<f64>,
    /// The middle shrinkage itself, 1 - with effects / refitted.
    pub median_shrinkage: Option<f64>,
}

impl Shrinkage {
    pub(super) fn of(outcomes: &[Outcome]) -> Self {
        let has_effects = |o: &&Outcome| matches!(o.kind, Kind::Single | Kind::Pair);
        let closed: Vec<Closed> =
            outcomes.iter().filter(has_effects).filter_map(Closed::of).collect();
        let shares: Vec<f64> = closed.iter().map(|closed| closed.share).collect();
        let cut: f64 = shares.iter().map(|share| share.clamp(0.0, 1.0)).sum();
        Self {
            cases: closed.len(),
            by_noise_floor: outcomes.iter().all(|outcome| outcome.ceiling_v.is_none()),
            mean: (!shares.is_empty()).then(|| cut / shares.len() as f64),
            median: median(shares),
            median_shrinkage: median(closed.iter().map(|closed| closed.shrinkage).collect()),
        }
    }
}

struct Closed {
    share: f64,
    shrinkage: f64,
}

impl Closed {
    fn of(outcome: &Outcome) -> Option<Self> {
        const LEAST_GAP: f64 = 1.1;
        let gap = &outcome.answer.report()?.gap;
        let refitted_v = rms(&gap.refitted_v)?;
        let with_effects_v = rms(&gap.with_effects_v)?;
        let ceiling_v = rms(outcome.ceiling_v.as_ref().unwrap_or(&gap.noise_floor_v))?;
        (refitted_v > LEAST_GAP * ceiling_v).then(|| Self {
            share: (refitted_v - with_effects_v) / (refitted_v - ceiling_v),
            shrinkage: 1.0 - with_effects_v / refitted_v,
        })
    }
}

/// Over all joints; `None` of nothing.
fn rms(values: &[f64]) -> Option<f64> {
    let power: f64 = values.iter().map(|x| x * x).sum();
    (!values.is_empty()).then(|| (power / values.len() as f64).sqrt())
}
