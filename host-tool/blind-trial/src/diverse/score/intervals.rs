//! How often intervals hold what is true.

use std::f64::consts::{PI, TAU};

use serde::Serialize;

use super::equivalence::names;
use crate::cause::TrueCause;
use crate::claim::Claim;
use crate::diverse::outcome::DiverseOutcome;
use crate::score::Share;
use diagnosis::Value;
use rig::effects::Kind;

/// How often intervals of names rightly given hold the truth.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Intervals {
    /// Of shares, between nothing and all of the gap as reports have them; those of all names of a true cause.
    pub shares: Share,
    /// Of parameters; those of causes named by their own name.
    pub parameters: Share,
}

impl Intervals {
    pub(super) fn of(outcomes: &[DiverseOutcome]) -> Self {
        let mut intervals = Self::default();
        for outcome in outcomes {
            for (truth, share) in outcome.truth.iter().zip(&outcome.told_shares) {
                let Some(claim) = outcome.claims.iter().find(|c| names(c, truth)) else { continue };
                let [from, to] = claim.share_interval;
                if let Some(share) = share {
                    intervals.shares =
                        intervals.shares.with((from..=to).contains(&share.clamp(0.0, 1.0)));
                }
                if claim.effect == truth.effect {
                    let held = parameters(claim, truth);
                    intervals.parameters = held.into_iter().fold(intervals.parameters, Share::with);
                }
            }
        }
        intervals
    }
}

/// Whether the interval of each parameter that has one holds the truth. Harmonics are tried and
/// not fitted, and a phase counts where its harmonic is right; of a lean, the angles count alone.
fn parameters(claim: &Claim, truth: &TrueCause) -> Vec<bool> {
    let known = truth.known_parameters();
    let leans = known.iter().any(|parameter| parameter.kind == Kind::Rotation);
    let mut held = Vec::new();
    let mut names: Vec<(&str, Kind)> = known.iter().map(|p| (p.name, p.kind)).collect();
    names.dedup();
    for (name, kind) in names {
        let counts = match kind {
            Kind::Harmonic | Kind::Choice => false,
            Kind::Phase => same_harmonic(claim, truth),
            _ => !leans || kind == Kind::Rotation,
        };
        if !counts {
            continue;
        }
        let values = components(truth.parameters.get(name));
        let intervals = claim.parameter_intervals.get(name).map_or(&[][..], Vec::as_slice);
        for (value, [from, to]) in values.iter().zip(intervals) {
            held.push(match kind {
                Kind::Phase => holds_phase(*value, *from, *to),
                _ => (*from..=*to).contains(value),
            });
        }
    }
    held
}

/// Whether an interval holds an angle or the same angle some turns further.
fn holds_phase(value: f64, from: f64, to: f64) -> bool {
    let middle = 0.5 * (from + to);
    let away = (value - middle + PI).rem_euclid(TAU) - PI;
    away.abs() <= 0.5 * (to - from)
}

fn same_harmonic(claim: &Claim, truth: &TrueCause) -> bool {
    let harmonic = truth.known_parameters().iter().find(|p| p.kind == Kind::Harmonic);
    harmonic.is_none_or(|harmonic| {
        let [a, b] =
            [&claim.parameters, &truth.parameters].map(|p| components(p.get(harmonic.name)));
        matches!((&a[..], &b[..]), ([a], [b]) if (a - b).abs() < 0.5)
    })
}

fn components(value: Option<&Value>) -> Vec<f64> {
    match value {
        Some(Value::Number(number)) => vec![*number],
        Some(Value::Vector(vector)) => vector.clone(),
        None => Vec::new(),
    }
}
