//! Causes and alternatives, as the report tells them.

use std::collections::BTreeMap;

use super::amended::parameters;
use super::sentence::effect_words;
use super::words::joint_words;
use crate::criteria::VerdictCriteria;
use crate::fit::cross_validation::NORMAL;
use crate::logs::subject::Subject;
use crate::result::{Alternative, Cause, Interval, Rival};
use crate::search::found;
use crate::search::objection::Objection;
use crate::trial::hypothesis::EffectInstance;
use crate::verdict::judged::Withheld;
use crate::verdict::judgement::{Judgement, Named};
use rig::effects::{Kind, Parameter};

/// The causes that are named, largest share first, and what could stand in their place.
pub fn causes(subject: &Subject, judgement: &Judgement) -> (Vec<Cause>, Vec<Alternative>) {
    let known = subject.known_effects.len();
    let mut order: Vec<usize> = (0..judgement.named.len()).collect();
    let share = |index: &usize| judgement.named[*index].worth.share;
    order.sort_by(|a, b| share(b).total_cmp(&share(a)));
    let (mut causes, mut alternatives) = (Vec::new(), Vec::new());
    let halves = judgement.last.linear.half_intervals(&judgement.last.evidence);
    for (place, index) in order.into_iter().enumerate() {
        let named = &judgement.named[index];
        causes.push(cause(subject, judgement, named, known + index, &halves));
        alternatives.extend(of_rivals(subject, judgement, named, known + index, place));
    }
    alternatives.extend(withheld(subject, judgement));
    let is_named = |other: &Alternative| {
        causes.iter().any(|c: &Cause| c.effect == other.effect && c.joint == other.joint)
    };
    alternatives.retain(|other| other.instead_of.is_none() || !is_named(other));
    alternatives.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    (causes, alternatives)
}

/// A cause; `halves` are half the intervals of all that is open in the model.
fn cause(
    subject: &Subject,
    judgement: &Judgement,
    named: &Named,
    index: usize,
    halves: &[f64],
) -> Cause {
    let effect = &judgement.last.linear.hypothesis.effects[index];
    Cause {
        effect: effect.definition.name.into(),
        joint: subject.outer_joint(effect.joint),
        parameters: parameters(effect),
        parameter_intervals: intervals(subject, judgement, effect, index, halves),
        probability: named.probability,
        confidence: named.probability,
        share: named.worth.share,
        share_interval: named.worth.share_interval,
        shrinkage: named.worth.shrinkage,
        shrinkage_interval: named.worth.shrinkage_interval,
        shrinkage_halves: None,
    }
}

/// Half the 95 % interval, in parts of itself, of what is measured through torque constants and lengths:
/// a mass is known no better than these.
fn half_of_scale(subject: &Subject, parameter: &Parameter) -> f64 {
    let is_mechanical = match parameter.kind {
        Kind::Mass | Kind::FirstMoment | Kind::Inertia | Kind::Force => true,
        Kind::Stiffness | Kind::Damping => parameter.name.contains("_Nm"),
        _ => false,
    };
    if is_mechanical { NORMAL * subject.criteria.prior.relative } else { 0.0 }
}

/// The interval of an effect's value with that by which it is told: a torque constant is told against the others, which may
/// be off as well.
fn with_told(subject: &Subject, effect: &EffectInstance, own: [f64; 2]) -> [f64; 2] {
    let told = subject.found_constants.get(&effect.joint).filter(|_| effect.is_torque_constant());
    told.map_or(own, |told| [own[0].min(told[0]), own[1].max(told[1])])
}

/// 95 % intervals of an effect's parameters, from the curvature of the fit and from what leaving out
/// parts of the logs changes, whichever is wider.
fn intervals(
    subject: &Subject,
    judgement: &Judgement,
    effect: &EffectInstance,
    index: usize,
    halves: &[f64],
) -> BTreeMap<String, Interval> {
    use crate::fit::unknowns::Unknown;
    let linear = &judgement.last.linear;
    let mut all = BTreeMap::<String, Interval>::new();
    for (value, parameter) in effect.definition.parameters.iter().enumerate() {
        let unknown = Unknown::Effect { index, value };
        let Some(place) = linear.place_of(unknown) else {
            continue;
        };
        let middle = effect.values[value];
        let half = halves[place].hypot(half_of_scale(subject, parameter) * middle);
        let [from, to] = with_told(subject, effect, [middle - half, middle + half]);
        let own = [from.max(parameter.lowest), to.min(parameter.highest)];
        let entry = match all.remove(parameter.name) {
            None => Interval::Number(own),
            Some(Interval::Number(first)) => Interval::Vector(vec![first, own]),
            Some(Interval::Vector(mut others)) => {
                others.push(own);
                Interval::Vector(others)
            }
        };
        all.insert(parameter.name.into(), entry);
    }
    all.retain(|name, _| parameters(effect).contains_key(name));
    all
}

/// Rivals of a cause that are not ruled out.
fn of_rivals(
    subject: &Subject,
    judgement: &Judgement,
    named: &Named,
    index: usize,
    place: usize,
) -> Vec<Alternative> {
    let criteria = &subject.criteria.verdict;
    let (confirmation, last) = (&judgement.confirmation, &judgement.last);
    let effect = &last.linear.hypothesis.effects[index];
    let alternative = |rival: &found::Rival| {
        let probability = probability_of_rival(named, effect, rival, criteria);
        let without_v = &confirmation.without[index - subject.known_effects.len()].residual_v;
        let with_v = &rival.model.all_residual_v();
        Alternative {
            effect: rival.effect.definition.name.into(),
            joint: subject.outer_joint(rival.effect.joint),
            probability,
            confidence: probability,
            instead_of: Some(place),
            share: confirmation.worth_of(last, &rival.effect, without_v, with_v).share,
            why: None,
        }
    };
    let mut all: Vec<Alternative> = named.added.rivals.iter().map(alternative).collect();
    all.retain(|other| other.probability >= criteria.least_alternative);
    all
}

/// Probability of a rival of a cause: what the cause's own name leaves of it where the rival says the same by another,
/// else by the log-likelihood that it has over the cause.
fn probability_of_rival(
    named: &Named,
    effect: &EffectInstance,
    rival: &found::Rival,
    criteria: &VerdictCriteria,
) -> f64 {
    if effect.says_the_same_as(&rival.effect) {
        return named.of_any - named.probability;
    }
    let odds = (criteria.log_likelihood_weight * rival.gain).exp();
    (named.of_any * odds).min(1.0 - named.of_any)
}

/// Effects that the search added and that are not named, and why.
fn withheld(subject: &Subject, judgement: &Judgement) -> Vec<Alternative> {
    let alternative = |Withheld { effect, judged, reason, rival }: &Withheld| Alternative {
        effect: effect.definition.name.into(),
        joint: subject.outer_joint(effect.joint),
        probability: judged.by_name,
        confidence: judged.by_name,
        instead_of: None,
        share: judged.worth.share,
        why: Some(reason.words().to_owned() + &in_its_place(subject, rival.as_ref())),
    };
    judgement.withheld.iter().map(alternative).collect()
}

/// ": delay on joint 3" of what may do the same; nothing where nothing may.
fn in_its_place(subject: &Subject, rival: Option<&EffectInstance>) -> String {
    rival.map_or_else(String::new, |rival| {
        let joint = joint_words(subject.outer_joint(rival.joint));
        format!(": {} on {joint}", effect_words(rival.definition.name))
    })
}

/// Why an effect was not added.
fn why_refused(refused: &found::Rival) -> String {
    let why = refused.objection.unwrap_or(Objection::Chance).words();
    format!("gains a log-likelihood of {:.0}, {why}", refused.gain)
}

/// What was tried and lost, the best first.
pub fn rivals(subject: &Subject, judgement: &Judgement) -> Vec<Rival> {
    let confirmation = &judgement.confirmation;
    let explained = |rival: &found::Rival| {
        let (refitted_v, model_v) =
            (&confirmation.refitted.residual_v, &rival.model.all_residual_v());
        confirmation.worth_of(&judgement.last, &rival.effect, refitted_v, model_v).share
    };
    let rival = |effect: &EffectInstance, explained: f64, why: String| Rival {
        effect: effect.definition.name.into(),
        joint: subject.outer_joint(effect.joint),
        parameters: parameters(effect),
        explained: explained.clamp(0.0, 1.0),
        why,
    };
    let mut all = Vec::new();
    for (index, named) in judgement.named.iter().enumerate() {
        let place = subject.known_effects.len() + index;
        let winner = effect_words(judgement.last.linear.hypothesis.effects[place].definition.name);
        all.extend(named.added.rivals.iter().map(|other| {
            let why = format!("a log-likelihood {:.0} below that of {winner}", -other.gain);
            rival(&other.effect, explained(other), why)
        }));
    }
    all.extend(
        judgement
            .refused
            .iter()
            .map(|other| rival(&other.effect, explained(other), why_refused(other))),
    );
    all.extend(judgement.withheld.iter().map(|Withheld { effect, judged, reason, .. }| {
        rival(effect, judged.worth.share, format!("not named: {}", reason.words()))
    }));
    all.sort_by(|a, b| b.explained.total_cmp(&a.explained));
    all
}
