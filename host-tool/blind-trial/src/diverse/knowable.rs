//! What somebody could know of a case who knows everything else of its reality.
//!
//! Twins of the case are recorded: with each cause alone, without any, and bare of clutter and
//! odd friction. The true model is refitted to each as far as the model given is in doubt.

use serde::Serialize;

use super::evidence::{Evidence, Refit, Weights};
use crate::case::Case;
use crate::error::TrialError;
use rig::effects::{Catalogue, Search};

/// Harmonics that a search tries, each a hypothesis of its own.
const HARMONICS: f64 = 24.0;
/// Below this many times the noise squared, an excess has no shares: some hundred independent
/// rows tell squares to a twentieth.
const LEAST_EXCESS: f64 = 0.1;

/// What could be known of one cause.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Known {
    /// The part of the excess that goes when it is added to all other causes, on the logs held
    /// out and on its joint; `None` where there is hardly any excess.
    pub share: Option<f64>,
    /// The probability that somebody who knows everything else names it.
    pub oracle: f64,
}

/// The twins that causes are judged by.
pub struct Twins {
    weights: Weights,
    /// Without causes.
    none: Twin,
    /// Without causes, clutter and friction of another law.
    bare: Twin,
}

struct Twin {
    evidence: Evidence,
    refit: Refit,
}

impl Twins {
    /// Those of a case.
    ///
    /// # Errors
    /// A recording that fails.
    pub fn of(case: &Case) -> Result<Self, TrialError> {
        let none = case.with_causes(Vec::new());
        let Some(reality) = &case.reality else {
            return Err(TrialError::NoReality(case.number));
        };
        let bare = evidence(&none.with_reality(reality.bare()))?;
        let none = evidence(&none)?;
        let weights = Weights::of(&none, &reality.model_error);
        let [none, bare] = [none, bare].map(|evidence| Twin::of(evidence, &weights));
        Ok(Self { weights, none, bare })
    }

    /// By how much the causes of a case, `part` times as large, make its logs more likely:
    /// twice the logarithm.
    pub fn gain(&self, of: &Evidence) -> impl Fn(f64) -> f64 + use<'_> {
        let refit = of.refit(&self.weights);
        move |part| self.weights.gain(&refit, &self.none.refit, part)
    }

    /// What could be known of each cause of a case.
    ///
    /// # Errors
    /// A recording that fails.
    pub fn known(&self, case: &Case) -> Result<Vec<Known>, TrialError> {
        let whole = Twin::of(evidence(case)?, &self.weights);
        let mut known = Vec::new();
        for cause in &case.causes {
            let alone = match &case.causes[..] {
                [_] => &whole,
                _ => {
                    let alone = case.with_causes(vec![cause.clone()]);
                    &Twin::of(evidence(&alone)?, &self.weights)
                }
            };
            let gain = self.weights.gain(&alone.refit, &self.none.refit, 1.0);
            let share = self.share(&whole, alone, cause.joint);
            known.push(Known { share, oracle: probability(gain) });
        }
        Ok(known)
    }

    /// (E without - E with) / (E without any cause - E noise), where what a twin leaves is what
    /// a model leaves that holds everything but its causes.
    fn share(&self, whole: &Twin, alone: &Twin, joint: u8) -> Option<f64> {
        let [any, without, with, noise] =
            [whole, alone, &self.none, &self.bare].map(|twin| twin.held_out_v2(joint));
        let excess = any - noise;
        (excess > LEAST_EXCESS * noise).then(|| ((without - with) / excess).clamp(-1.0, 2.0))
    }
}

impl Twin {
    fn of(evidence: Evidence, weights: &Weights) -> Self {
        Self { refit: evidence.refit(weights), evidence }
    }

    /// On a joint (1 to 3), or on all (0).
    fn held_out_v2(&self, joint: u8) -> f64 {
        let counts = |index: usize| joint == 0 || index + 1 == usize::from(joint);
        self.evidence.held_out_v2(&self.refit, counts)
    }
}

/// What a case leaves, before clock and bus touch the logs.
fn evidence(case: &Case) -> Result<Evidence, TrialError> {
    Evidence::of(case, &case.record_undamaged()?)
}

/// How many hypotheses somebody chooses among: effects on joints, harmonics one by one.
pub fn hypotheses() -> f64 {
    let catalogue = Catalogue::standard();
    let each = catalogue.iter().map(|definition| {
        let joints = if definition.whole_robot { 1.0 } else { 3.0 };
        match definition.search {
            Search::Harmonics(_) => joints * HARMONICS,
            Search::From(_) => joints,
        }
    });
    each.sum()
}

/// 1 / (1 + exp(-gain / 2 + ln(hypotheses))).
fn probability(gain: f64) -> f64 {
    1.0 / (1.0 + (-0.5 * gain + hypotheses().ln()).exp())
}

/// The part of a cause at which it just shows: its gain pays for the choice among all. Sought
/// between a thousandth and `most`.
pub fn smallest_part(gain: impl Fn(f64) -> f64, most: f64) -> f64 {
    let wanted = 2.0 * hypotheses().ln();
    let (mut low, mut high) = (1e-3_f64, most);
    for _ in 0..40 {
        let middle = (low * high).sqrt();
        if gain(middle) < wanted { low = middle } else { high = middle }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_just_shows_is_as_likely_as_not() {
        let part = smallest_part(|part| 1e4 * part * part, 2.0);
        assert!((probability(1e4 * part * part) - 0.5).abs() < 1e-3);
        assert!(probability(0.0) < 0.01 && probability(100.0) > 0.99);
        assert!(smallest_part(|_| 0.0, 2.0) > 1.99);
        assert!((100.0..500.0).contains(&hypotheses()));
    }
}
