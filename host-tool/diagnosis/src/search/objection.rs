//! What speaks against an effect that would be added to the model.

use super::enough::takes_enough;
use super::policy::{gain, left_on_v2};
use crate::criteria::Criteria;
use crate::fit::fitted_model::FittedModel;
use crate::fit::residual_stats::ResidualStats;
use crate::trial::hypothesis::EffectInstance;

/// Why a model with an effect more is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Objection {
    /// It does not explain what was left out better, by what chance alone may gain.
    Chance,
    /// A spring between motor and link that takes a small part of what is left, on its joint and on all: it smooths
    /// something else, and hides it.
    Smoothing,
    /// It needs parameters far from what is known of the arm.
    Implausible,
    /// It takes noise for motion: a spring rings, and that shows in the rows; where those are noise
    /// alone, it could only smooth what a coarse encoder reads.
    Noise,
    /// It takes a small part of what is left, which may be the method's own.
    SmallPart,
    /// It is none of these, but not once its fit is carried on to the end.
    Unsettled,
}

impl Objection {
    /// In words, after "gains a log-likelihood of so much".
    pub fn words(self) -> &'static str {
        match self {
            Self::Chance => "which is not enough",
            Self::Smoothing => {
                "but takes a small part of what is left on its joint and on all, as a spring that smooths"
            }
            Self::Implausible => "but with parameters far from what is known of the arm",
            Self::Noise => "but takes noise of the encoder for motion",
            Self::SmallPart => "but takes too small a part of what is left",
            Self::Unsettled => "but does not hold once it is refitted to the end",
        }
    }
}

/// What speaks against a model with an effect more, its last, `None` where it is accepted: it explains what was
/// left out better, and neither by implausible parameters nor by taking noise for motion.
pub fn objection(
    before: &FittedModel,
    after: &FittedModel,
    criteria: &Criteria,
) -> Option<Objection> {
    let last = after.linear.hypothesis.effects.last();
    objection_to(last, before, after, criteria)
}

/// The same of another of the effects of the model `after`, which the one `before` does not have.
pub fn objection_to(
    effect: Option<&EffectInstance>,
    before: &FittedModel,
    after: &FittedModel,
    criteria: &Criteria,
) -> Option<Objection> {
    let (from, to) = (&before.stats, &after.stats);
    let is_new = !is_exchange(before, after);
    let spring = effect.filter(|effect| effect.is_spring());
    if spring.is_some() && (from.excess <= 0.0 || takes_noise(from, to, criteria)) {
        Some(Objection::Noise)
    } else if is_new && spring.is_some_and(|spring| smooths(spring, before, after, criteria)) {
        Some(Objection::Smoothing)
    } else if makes_implausible(before, after, criteria) {
        Some(Objection::Implausible)
    } else if gain(before, after) <= criteria.selection.least_log_likelihood {
        Some(Objection::Chance)
    } else if is_new && !takes_enough(effect, before, after, criteria) {
        Some(Objection::SmallPart)
    } else {
        None
    }
}

/// Whether a spring between motor and link takes less than most of what is left, on its joint and on all: one
/// like this smooths something else, and hides it. What a spring smooths is mostly its own joint's; a link that swings
/// pulls at the others, and they may show it best where its own joint has another cause.
fn smooths(
    spring: &EffectInstance,
    before: &FittedModel,
    after: &FittedModel,
    criteria: &Criteria,
) -> bool {
    let leaves = 1.0 - criteria.selection.least_by_spring;
    let takes_most = |joint| left_on_v2(after, joint) < leaves * left_on_v2(before, joint);
    !takes_most(spring.joint) && !takes_most(0)
}

/// Whether one effect took the place of another, as a better spring does: then to explain better is
/// enough.
fn is_exchange(before: &FittedModel, after: &FittedModel) -> bool {
    let count = |model: &FittedModel| model.linear.hypothesis.effects.len();
    count(before) == count(after)
}

/// An effect that takes away every command, a wide dead zone say, "explains" any motion once the
/// refit takes away all masses.
///
/// Parameters may go a little further than is plausible, or than they were where that was implausible already, for
/// an effect that gains many times what they lose: friction of another law bends them, the more the less else is
/// left to.
fn makes_implausible(before: &FittedModel, after: &FittedModel, criteria: &Criteria) -> bool {
    let loss = 0.5 * (after.linear.prior_penalty() - before.linear.prior_penalty());
    parameters_go_too_far((&before.stats, &after.stats), loss, || gain(before, after), criteria)
}

/// Whether parameters leave what is plausible, by more than a little or for an effect that does not gain many times what
/// they lose.
fn parameters_go_too_far(
    (before, after): (&ResidualStats, &ResidualStats),
    loss: f64,
    gain: impl FnOnce() -> f64,
    criteria: &Criteria,
) -> bool {
    let policy = &criteria.selection;
    let (from, to) = (before.robot_penalty, after.robot_penalty);
    let grows = to > policy.most_prior_penalty_growth * from;
    if !after.is_implausible(&criteria.fit) || !grows {
        return false;
    }
    let may_go_to = from.max(after.most_robot_penalty(&criteria.fit));
    to >= policy.most_growth_of_implausible * may_go_to
        || loss >= policy.most_penalty_of_gain * gain()
}

/// A soft spring smooths what encoder steps add.
fn takes_noise(before: &ResidualStats, after: &ResidualStats, criteria: &Criteria) -> bool {
    let policy = &criteria.selection;
    after.over_encoder_noise < policy.least_of_encoder_noise
        && before.over_encoder_noise < policy.near_encoder_noise
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What parameters leave whose penalty, in units of tolerance, is this.
    fn stats(robot_penalty: f64) -> ResidualStats {
        ResidualStats {
            ratios: Vec::new(),
            excess: 0.0,
            over_encoder_noise: 1.0,
            prior_penalty: robot_penalty,
            robot_penalty,
            expected_penalty: 30.0,
        }
    }

    /// An effect that gains so much, by parameters whose penalty grows so.
    fn is_refused(from: f64, to: f64, gain: f64) -> bool {
        let (before, after) = (stats(from), stats(to));
        parameters_go_too_far((&before, &after), 0.5 * (to - from), || gain, &Criteria::default())
    }

    #[test]
    fn parameters_go_a_little_beyond_what_is_plausible_for_what_gains_many_times_their_loss() {
        assert!(!is_refused(90.0, 230.0, 1.0), "what is plausible is no matter of gain");
        assert!(
            !is_refused(90.0, 330.0, 7500.0),
            "a load that is plain, beside friction of another law"
        );
        assert!(
            is_refused(90.0, 330.0, 80.0),
            "a force that gains hardly more than parameters lose"
        );
        assert!(is_refused(90.0, 600.0, 50_000.0), "masses that are taken away");
        assert!(!is_refused(400.0, 700.0, 7500.0), "further off before it already");
        assert!(is_refused(400.0, 900.0, 50_000.0), "twice as far as before it");
    }
}
