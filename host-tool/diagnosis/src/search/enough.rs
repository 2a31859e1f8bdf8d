//! Whether an effect takes enough of what is left to be more than the method's own errors.

use super::policy::{gain, periods_passed};
use crate::criteria::Criteria;
use crate::fit::excess::{LeftOfLog, excess_v2, left_by_log};
use crate::fit::fitted_model::FittedModel;
use crate::fit::residual_stats::ResidualStats;
use crate::trial::hypothesis::EffectInstance;
use files::Role;

/// Whether the model `after`, which has an effect more, leaves enough less than the one `before`: a good part less of a
/// joint or of a log, or parameters nearer to what is known of them.
pub(super) fn takes_enough(
    effect: Option<&EffectInstance>,
    before: &FittedModel,
    after: &FittedModel,
    criteria: &Criteria,
) -> bool {
    reduces_excess(before, after, criteria)
        || reduces_one_log(before, after, criteria)
        || restores_prior(&before.stats, &after.stats, criteria)
        || is_sure_wave(effect, before, after, criteria)
}

/// Whether a good part of what is left of all logs of some joint goes.
fn reduces_excess(before: &FittedModel, after: &FittedModel, criteria: &Criteria) -> bool {
    let least = criteria.selection.least_of_excess;
    let of_joints =
        |model: &FittedModel| excess_v2(&model.evidence, &model.left_out_v, Role::Train);
    let (from, to) = (of_joints(before), of_joints(after));
    from.iter().zip(&to).any(|(from, to)| *from > 0.0 && *to < (1.0 - least) * from)
}

/// Whether a good part of what is left of one log goes: what another cause leaves of one kind of motion may be most of all
/// that is left.
fn reduces_one_log(before: &FittedModel, after: &FittedModel, criteria: &Criteria) -> bool {
    let of_logs =
        |model: &FittedModel| left_by_log(&model.evidence, &model.left_out_v, Role::Train);
    any_loses_much(&of_logs(before), &of_logs(after), criteria)
}

/// Whether some of what is left, where that is more than the method's own, loses a good part of what is above the noise.
fn any_loses_much(before: &[LeftOfLog], after: &[LeftOfLog], criteria: &Criteria) -> bool {
    let least = criteria.selection.least_of_log_excess;
    let own_square = criteria.fit.own_ratio.powi(2);
    let above = |left: &LeftOfLog| left.square_v2 - left.noise_v2;
    let loses_much = |(from, to): (&LeftOfLog, &LeftOfLog)| {
        from.square_v2 > own_square * from.noise_v2 && above(to) < (1.0 - least) * above(from)
    };
    before.iter().zip(after).any(loses_much)
}

/// Whether an effect is a wave of voltage of which a log holds some periods, and gains far more than any effect must. Most of
/// what is left is around reversals, where the method errs most; a wave of voltage is small against it, and is there
/// all the way between.
fn is_sure_wave(
    effect: Option<&EffectInstance>,
    before: &FittedModel,
    after: &FittedModel,
    criteria: &Criteria,
) -> bool {
    let plant = &after.linear.hypothesis.plant;
    let periods = effect.and_then(|effect| periods_passed(effect, plant, &after.evidence));
    let least = criteria.selection.least_periods_of_sure_wave;
    periods.is_some_and(|periods| periods > least) && gain(before, after) > sure_gain(criteria)
}

/// A log-likelihood that is far more than any effect must gain.
fn sure_gain(criteria: &Criteria) -> f64 {
    criteria.selection.sure_gain * criteria.selection.least_log_likelihood
}

/// Whether the effect brings parameters back to what is known of them: by a good part of their penalty,
/// of which other effects hold the rest, and by as much as makes half of what any effect must gain.
fn restores_prior(before: &ResidualStats, after: &ResidualStats, criteria: &Criteria) -> bool {
    let policy = &criteria.selection;
    let least =
        (policy.least_of_prior_penalty * before.prior_penalty).max(policy.least_log_likelihood);
    before.prior_penalty - after.prior_penalty > least
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is left of two logs, in squares of noise.
    fn left(squares: [f64; 2]) -> Vec<LeftOfLog> {
        squares.map(|square_v2| LeftOfLog { square_v2, noise_v2: 1.0 }).to_vec()
    }

    #[test]
    fn what_loses_much_of_one_log_that_is_more_than_the_methods_own_is_enough() {
        let criteria = Criteria::default();
        let loses = |from, to| any_loses_much(&left(from), &left(to), &criteria);
        assert!(loses([100.0, 5.0], [99.0, 2.0]));
        assert!(!loses([100.0, 5.0], [90.0, 4.5]), "a tenth of each");
        assert!(!loses([100.0, 2.0], [99.0, 1.0]), "the method's own");
    }
}
