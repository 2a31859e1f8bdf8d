//! Which causes are named, how sure they are, and what the verdict is in one word.

use super::confirmed::Confirmation;
use super::judged::Reason;
use super::worth::Worth;
use crate::criteria::VerdictCriteria;
use crate::fit::fitted_model::FittedModel;
use crate::result::Verdict;
use crate::rows::evidence::Rows;
use crate::search::found::{Added, Rival};
use crate::trial::hypothesis::EffectInstance;

/// Probability that an added effect is a cause.
#[derive(Clone, Copy, Debug)]
pub struct ProbabilityOfCause {
    /// By whichever name.
    pub of_any: f64,
    /// By its own, where others say the same: one half at least, if that is what is likely at all.
    pub by_name: f64,
}

/// Probability that an added effect is a cause: against each of its rivals by the log-likelihood
/// that it has over it, and against chance by the one that the model loses without it. A rival that says
/// the same by another name is none.
pub fn probability(
    effect: &EffectInstance,
    added: &Added,
    worth: &Worth,
    criteria: &VerdictCriteria,
) -> ProbabilityOfCause {
    let gains = |rivals: &[&Rival]| rivals.iter().map(|rival| rival.gain).collect::<Vec<f64>>();
    let (same, others): (Vec<&Rival>, Vec<&Rival>) =
        added.rivals.iter().partition(|rival| effect.says_the_same_as(&rival.effect));
    by_gains([&gains(&same), &gains(&others)], added.gain, worth, criteria)
}

/// The same of an effect that gains so much, by the gains of the `same` under other names, and of `others`, over it.
fn by_gains(
    [same, others]: [&[f64]; 2],
    gain: f64,
    worth: &Worth,
    criteria: &VerdictCriteria,
) -> ProbabilityOfCause {
    let of_any = probability_among(others, gain, worth, criteria);
    let of_name = probability_among(&[same, others].concat(), gain, worth, criteria);
    ProbabilityOfCause { of_any, by_name: of_name.max(of_any.min(criteria.least_probability)) }
}

/// The same of one name among rivals that gain so much over it.
fn probability_among(rivals: &[f64], gain: f64, worth: &Worth, criteria: &VerdictCriteria) -> f64 {
    let odds = |log_likelihood: f64| (criteria.log_likelihood_weight * log_likelihood).exp();
    let rivals: f64 = rivals.iter().map(|gain| odds(*gain)).sum();
    let chance = odds(-gain) * criteria.tried_by_chance;
    let doubt = 1.0 - confirmed(worth, criteria);
    criteria.highest_probability * (1.0 - doubt) / (1.0 + rivals + chance)
}

/// Why an effect has a probability below one half: something else may do the same, or chance.
pub fn why_unlikely(added: &Added, worth: &Worth, criteria: &VerdictCriteria) -> Reason {
    let alone = probability_among(&[], added.gain, worth, criteria);
    if alone >= criteria.least_probability { Reason::Rival } else { Reason::Unlikely }
}

/// How well a worth is confirmed, 0 to 1: its shrinkage against the half width of that interval.
/// The share's is wide where few blocks hold most of the gap, however surely each of them shrinks.
fn confirmed(worth: &Worth, criteria: &VerdictCriteria) -> f64 {
    let half_width = 0.5 * (worth.shrinkage_interval[1] - worth.shrinkage_interval[0]);
    let deviations = 1.96 * worth.shrinkage / half_width.max(1e-9);
    (deviations / criteria.sure_deviations).clamp(0.0, 1.0)
}

/// Why a cause is not named, where it is not; `explained` is the part of the arm's gap that all causes take together, where
/// there is none that of the joints on which it acts, and `no_gap` whether there is none. One that is not sure, or that is found where there is no gap, takes half of
/// what is left without it, and causes half of the gap: where most stays, something else may be the cause of
/// all of it, on that joint or, as a belt between two, on the arm.
pub fn why_not_named(
    effect: &EffectInstance,
    probability: f64,
    worth: &Worth,
    explained: f64,
    no_gap: bool,
    criteria: &VerdictCriteria,
) -> Option<Reason> {
    let is_sure_of = |worth| {
        is_sure_enough(probability, worth, explained, criteria)
            || is_sure_of_faint(effect, probability, worth, explained, criteria)
    };
    let sure = probability >= criteria.sure_probability && !no_gap;
    let most = worth.part_of_left.min(explained) >= criteria.most_of_left;
    if probability < criteria.least_probability {
        Some(Reason::Unlikely)
    } else if !is_large(worth, criteria) && (no_gap || !is_sure_of(worth)) {
        Some(Reason::Small)
    } else if worth.share_interval[0] <= 0.0 {
        Some(Reason::NoShare)
    } else {
        let reason = if no_gap { Reason::NearNoise } else { Reason::MostStays };
        (!sure && !most).then_some(reason)
    }
}

/// Whether a cause is more than what nobody's formula leaves: a good part of the gap, or most of
/// what is left without it.
fn is_large(worth: &Worth, criteria: &VerdictCriteria) -> bool {
    let of_gap =
        worth.share >= criteria.least_share && worth.part_of_left >= criteria.least_part_of_left;
    let of_left =
        worth.share >= criteria.least_small_share && worth.part_of_left >= criteria.most_of_left;
    of_gap || of_left
}

/// Whether a cause that takes little is named all the same: it is likely enough, takes a hundredth of the gap, and causes
/// together a good part: beside a gap that stays, something small may be a trace of what makes all of it.
fn is_sure_enough(
    probability: f64,
    worth: &Worth,
    explained: f64,
    criteria: &VerdictCriteria,
) -> bool {
    probability >= criteria.sure_of_small
        && worth.share >= criteria.least_small_share
        && explained >= criteria.least_share
}

/// Whether a cause is named that takes less than a hundredth of the gap: it is nearly sure, takes a good part of what is left
/// without it, and causes together take nearly all. Friction of another law than the model's leaves as little in the end, and
/// what changes friction, or grows with speed, follows it; masses and friction that are off a little look like a load or a
/// torque constant.
fn is_sure_of_faint(
    effect: &EffectInstance,
    probability: f64,
    worth: &Worth,
    explained: f64,
    criteria: &VerdictCriteria,
) -> bool {
    let is_told_apart = !effect.resembles_friction() && !effect.resembles_parameters();
    is_told_apart
        && probability >= criteria.sure_of_faint
        && worth.part_of_left >= criteria.least_part_of_left
        && explained >= criteria.explained
}

/// Whether there is no gap: train logs leave noise alone and confirming ones not much more, or the
/// confirming ones leave noise alone and no train log much more. One log may leave more than its
/// noise where it is sampled too coarsely for what it holds: commands between samples, say.
pub fn is_no_gap(
    refitted: &FittedModel,
    last: &FittedModel,
    confirmation: &Confirmation,
    criteria: &VerdictCriteria,
) -> bool {
    let gap = &refitted.stats;
    let over_noise = confirmation.over_noise(last);
    let quiet = gap.excess == 0.0 || gap.worst() < criteria.no_gap_ratio;
    let confirmed = over_noise < criteria.no_gap_ratio
        && gap.worst() < criteria.most_in_one_log
        && gap.prior_penalty < criteria.most_prior_penalty;
    (quiet && over_noise < criteria.far_above_noise) || confirmed
}

/// The verdict in one word; `last` has just the causes that are named.
pub fn verdict(
    refitted: &FittedModel,
    last: &FittedModel,
    with_tables_v: &Rows,
    named: usize,
    confirmation: &Confirmation,
    criteria: &VerdictCriteria,
) -> Verdict {
    match named {
        0 if is_no_gap(refitted, last, confirmation, criteria) => Verdict::None,
        0 => Verdict::Unknown,
        _ if confirmation.explained(last) >= criteria.explained
            && confirmation.is_drawn(last, with_tables_v) =>
        {
            Verdict::Effect
        }
        _ => Verdict::Partial,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Criteria;
    use rig::effects::Catalogue;

    /// An effect of the catalogue on joint 1.
    fn effect(name: &str) -> EffectInstance {
        let definition = Catalogue::standard().by_name(name).unwrap();
        EffectInstance { definition, joint: 1, values: vec![0.1; definition.parameters.len()] }
    }

    /// Takes two thirds of what is left without it, and a tenth of the gap or more.
    fn worth() -> Worth {
        Worth {
            share: 0.2,
            share_interval: [0.05, 0.5],
            remainder: 0.1,
            part_of_left: 0.67,
            shrinkage: 0.4,
            shrinkage_interval: [0.3, 0.5],
        }
    }

    #[test]
    fn a_lag_is_as_likely_as_a_lag_or_a_delay_together_and_half_so_by_its_name() {
        let criteria = Criteria::default().verdict;
        let of = |same: &[f64], others: &[f64]| by_gains([same, others], 80.0, &worth(), &criteria);
        let twins = of(&[0.0], &[]);
        assert!(twins.of_any > 0.97 && twins.by_name == 0.5, "{twins:?}");
        let told_apart = of(&[-40.0], &[]);
        assert!(told_apart.by_name > 0.95, "{told_apart:?}");
        let beside_another = of(&[0.0], &[0.0]);
        assert!(beside_another.of_any < 0.5, "a dead zone may do it, too: {beside_another:?}");
        assert_eq!(beside_another.by_name, beside_another.of_any);
    }

    #[test]
    fn a_cause_that_is_not_twice_as_likely_as_not_is_named_where_causes_take_most_of_the_gap() {
        let criteria = Criteria::default().verdict;
        let against = |probability, explained| {
            why_not_named(&effect("cogging"), probability, &worth(), explained, false, &criteria)
        };
        assert_eq!((against(0.6, 0.6), against(0.7, 0.2)), (None, None));
        assert_eq!(against(0.6, 0.2), Some(Reason::MostStays));
        assert_eq!(against(0.4, 0.9), Some(Reason::Unlikely));
    }

    #[test]
    fn a_small_cause_is_named_where_it_is_four_times_as_likely_as_not() {
        let criteria = Criteria::default().verdict;
        let small = Worth { share: 0.03, part_of_left: 0.1, ..worth() };
        let effect = effect("asymmetric_friction");
        let against = |probability, worth, no_gap| {
            why_not_named(&effect, probability, worth, 0.9, no_gap, &criteria)
        };
        assert_eq!(
            (against(0.79, &small, false), against(0.81, &small, false)),
            (Some(Reason::Small), None)
        );
        assert_eq!(against(0.98, &small, true), Some(Reason::Small));
        let nothing = Worth { share: 0.009, ..small };
        assert_eq!(against(0.98, &nothing, false), Some(Reason::Small));
    }

    /// A dead zone that is there took 0.4 % of a gap and 61 % of what was left without it; on geared arms of another engine
    /// friction's peaks took as little, and up to eight tenths.
    #[test]
    fn a_faint_cause_is_named_where_it_is_sure_and_nothing_else_stays_or_looks_like_it() {
        let criteria = Criteria::default().verdict;
        let faint = Worth { share: 0.004, share_interval: [0.001, 0.046], ..worth() };
        let against = |name, probability, worth: &Worth, explained| {
            why_not_named(&effect(name), probability, worth, explained, false, &criteria)
        };
        assert_eq!(against("dead_zone", 0.98, &faint, 0.99), None);
        assert_eq!(against("dead_zone", 0.9, &faint, 0.99), Some(Reason::Small));
        assert_eq!(against("dead_zone", 0.98, &faint, 0.85), Some(Reason::Small), "much stays");
        let trace = Worth { part_of_left: 0.1, ..faint };
        assert_eq!(against("dead_zone", 0.98, &trace, 0.99), Some(Reason::Small));
        let friction = ["asymmetric_friction", "quadratic_drag", "load_friction"];
        for name in friction.into_iter().chain(["payload", "torque_constant"]) {
            assert_eq!(against(name, 0.98, &faint, 0.99), Some(Reason::Small), "{name}");
        }
    }

    /// On a clean arm whose friction is of another law a limit took 3 % of a joint's gap, sure, and all else stayed.
    #[test]
    fn a_small_cause_is_not_named_where_nearly_all_of_the_gap_stays() {
        let criteria = Criteria::default().verdict;
        let small = Worth { share: 0.03, part_of_left: 0.1, ..worth() };
        let saturation = effect("saturation");
        let against =
            |explained| why_not_named(&saturation, 0.98, &small, explained, false, &criteria);
        assert_eq!((against(-0.05), against(0.03)), (Some(Reason::Small), Some(Reason::Small)));
        assert_eq!(against(0.11), None);
    }

    #[test]
    fn what_is_below_a_hundredth_or_near_the_noise_is_not_named_however_sure() {
        let criteria = Criteria::default().verdict;
        let sure = worth();
        let asymmetry = effect("asymmetric_friction");
        let against =
            |worth: &Worth, no_gap| why_not_named(&asymmetry, 0.98, worth, 0.9, no_gap, &criteria);
        assert_eq!(against(&sure, true), None);
        assert_eq!(against(&Worth { part_of_left: 0.3, ..sure }, false), None);
        assert_eq!(against(&Worth { part_of_left: 0.3, ..sure }, true), Some(Reason::NearNoise));
        assert_eq!(against(&Worth { share: 0.005, ..sure }, false), Some(Reason::Small));
        let nothing = Worth { share_interval: [-0.01, 0.5], ..sure };
        assert_eq!(against(&nothing, false), Some(Reason::NoShare));
    }
}
