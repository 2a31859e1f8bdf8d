//! What somebody could know of a case who knows everything else of its reality.
//!
//! Twins of the case are recorded without noise, so that what a cause adds is the difference of two
//! recordings: with each cause alone, without any, and bare of clutter and odd friction. One with
//! noise tells what clutter, friction and noise leave. The true model is refitted to each as far as
//! the model given is in doubt.

use serde::Serialize;

use super::evidence::{Evidence, Refit, Weights};
use crate::case::{Case, Recorded};
use crate::error::TrialError;
use rig::effects::{Catalogue, Search};

/// Harmonics that a search tries, each a hypothesis of its own.
const HARMONICS: f64 = 24.0;
/// Below this part of what clutter, friction and noise leave, an excess has no shares: some
/// hundred independent rows tell squares to a twentieth.
const LEAST_EXCESS: f64 = 0.05;

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
    /// Without causes, with noise.
    noisy: Twin,
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
        let noisy = Evidence::of(&none, &none.record_undamaged()?)?;
        let weights = Weights::of(&noisy, &reality.model_error);
        let bare = Twin::of(quiet_evidence(&none.with_reality(reality.bare()))?, &weights);
        let none = Twin::of(quiet_evidence(&none)?, &weights);
        Ok(Self { noisy: Twin::of(noisy, &weights), none, bare, weights })
    }

    /// By how much a cause that was recorded alone and without noise, `part` times as large,
    /// makes its logs more likely: twice the logarithm.
    ///
    /// # Errors
    /// Logs too short to be judged.
    pub fn gain(
        &self,
        probe: &Case,
        recorded: &[Recorded],
    ) -> Result<impl Fn(f64) -> f64 + use<'_>, TrialError> {
        let refit = self.added(Evidence::of(probe, recorded)?);
        Ok(move |part| self.weights.gain(&refit, part))
    }

    /// A refit to what a cause alone adds to the twin without it.
    fn added(&self, alone: Evidence) -> Refit {
        alone.less(&self.none.evidence).refit(&self.weights)
    }

    /// What could be known of each cause of a case.
    ///
    /// # Errors
    /// A recording that fails.
    pub fn known(&self, case: &Case) -> Result<Vec<Known>, TrialError> {
        let whole = Twin::of(quiet_evidence(case)?, &self.weights);
        let known = case.causes.iter().map(|cause| {
            let alone = quiet_evidence(&case.with_causes(vec![cause.clone()]))?;
            let alone = Twin::of(alone, &self.weights);
            let share = self.share(&whole, &alone, cause.joint);
            let gain = self.weights.gain(&self.added(alone.evidence), 1.0);
            Ok(Known { share, oracle: probability(gain) })
        });
        known.collect()
    }

    /// (E without - E with) / (E without any cause - E noise), where what a twin leaves is what
    /// a model leaves that holds everything but its causes.
    fn share(&self, whole: &Twin, alone: &Twin, joint: u8) -> Option<f64> {
        let [any, without, with, noise, yardstick] =
            [whole, alone, &self.none, &self.bare, &self.noisy].map(|twin| twin.held_out_v2(joint));
        let excess = any - noise;
        (excess > LEAST_EXCESS * yardstick).then(|| ((without - with) / excess).clamp(-1.0, 2.0))
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

/// The same case without noise.
pub fn quiet(case: &Case) -> Case {
    let reality = case.reality.as_ref().map(|reality| reality.quiet());
    Case { noise_v: 0.0, reality, ..case.clone() }
}

/// What a case leaves without noise, before clock and bus touch the logs.
fn quiet_evidence(case: &Case) -> Result<Evidence, TrialError> {
    let case = quiet(case);
    Evidence::of(&case, &case.record_undamaged()?)
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
