//! What was found as `report.json` says it.

use diagnosis::{Alternative, Cause, DataParts, Gap, Interval, Report, Value, Verdict};
use files::Role;

use crate::confirm::{Taken, probability};
use crate::effect_table::{parameter_name, parameters};
use crate::joint_effects::noise;
use crate::outcome::Outcome;
use crate::report_intervals::intervals;
use crate::verdict::JointCause;
use crate::whole_cause::WholeCause;
use crate::whole_table;
use crate::{report_changes, report_gap, report_places, report_remarks};

/// The version of the layout.
const FORMAT: u32 = 2;

/// The report of an outcome.
pub fn report(outcome: &Outcome) -> Report {
    let causes = causes(outcome);
    let gap = report_gap::gap(outcome);
    let verdict = verdict(outcome, &causes, &gap);
    Report {
        format: FORMAT,
        verdict,
        alternatives: alternatives(outcome, &causes),
        parameters_changed: report_changes::changes(outcome),
        remainder: report_gap::remainder(outcome, &gap),
        gap_shares: report_places::places(outcome, &gap),
        data: data(outcome),
        untestable: report_remarks::untestable(outcome),
        remarks: report_remarks::remarks(outcome),
        contact: Some(outcome.prepared.contacts.clone()),
        detectable: Vec::new(),
        model_fault: None,
        causes,
        gap,
    }
}

/// What is named, largest share first.
fn causes(outcome: &Outcome) -> Vec<Cause> {
    let whole = outcome.whole.iter().filter(|cause| cause.is_named).map(of_whole);
    let named = outcome.causes.iter().filter(|cause| cause.is_named);
    let mut found: Vec<Cause> = whole.chain(named.map(|cause| of_joint(outcome, cause))).collect();
    for pooled in outcome.pooled.iter().filter_map(|(_, causes)| causes.iter().find(|c| c.is_named))
    {
        let is_there = |cause: &Cause| cause.effect == pooled.effect;
        if !found.iter().any(is_there) {
            found.push(of_joint(outcome, pooled));
        }
    }
    found.sort_by(|a, b| b.share.total_cmp(&a.share));
    found
}

fn of_joint(outcome: &Outcome, cause: &JointCause) -> Cause {
    let named = parameters(cause.effect, &cause.servo);
    let values = named.iter().map(|(name, value)| ((*name).to_owned(), Value::Number(*value)));
    let found = intervals(outcome, cause).into_iter().filter_map(|(field, interval)| {
        let name = parameter_name(cause.effect, field)?;
        Some((name.to_owned(), Interval::Number(interval)))
    });
    let (parameters, parameter_intervals) = (values.collect(), found.collect());
    let bare = with_share(cause.effect, cause.joint + 1, &cause.taken, cause.probability);
    Cause { parameters, parameter_intervals, ..bare }
}

fn of_whole(cause: &WholeCause) -> Cause {
    let fit = &cause.fit;
    let mut spread = fit.deviations.iter();
    let (mut values, mut found) = (Vec::new(), Vec::new());
    for (name, numbers, is_vector) in whole_table::parameters(fit.effect, &fit.values) {
        let interval = |value: &f64| {
            let half = 1.96 * spread.next().copied().unwrap_or(0.0);
            [value - half, value + half]
        };
        let around: Vec<[f64; 2]> = numbers.iter().map(interval).collect();
        let (value, interval) = match is_vector {
            true => (Value::Vector(numbers), Interval::Vector(around)),
            false => (Value::Number(numbers[0]), Interval::Number(around[0])),
        };
        values.push((name.to_owned(), value));
        found.push((name.to_owned(), interval));
    }
    let bare = with_share(fit.effect.name(), 0, &cause.taken, cause.probability);
    let (parameters, intervals) = (values.into_iter().collect(), found.into_iter().collect());
    Cause { parameters, parameter_intervals: intervals, ..bare }
}

fn with_share(effect: &str, joint: usize, taken: &Taken, probability: f64) -> Cause {
    Cause {
        effect: effect.to_owned(),
        joint: joint as u8,
        parameters: Default::default(),
        parameter_intervals: Default::default(),
        probability,
        confidence: probability,
        share: taken.share,
        share_interval: taken.share_interval,
        shrinkage: taken.shrinkage,
        shrinkage_interval: taken.shrinkage_interval,
        shrinkage_halves: Some(taken.halves),
    }
}

/// What was selected and not confirmed, and what does the same as something else.
fn alternatives(outcome: &Outcome, named: &[Cause]) -> Vec<Alternative> {
    let joint = outcome.causes.iter().filter(|cause| !cause.is_named).map(|cause| {
        alternative(
            cause.effect,
            cause.joint + 1,
            cause.probability.min(0.49),
            cause.taken.share,
            UNCONFIRMED,
        )
    });
    let undecided = outcome.selected.iter().enumerate().flat_map(|(joint, selected)| {
        let part = 0.5 / selected.undecided.len().max(1) as f64;
        selected.undecided.iter().map(move |tried| {
            let likely = part * (2.0 * probability(tried.gain.certainty) - 1.0);
            alternative(tried.effect, joint + 1, likely, tried.gain.part, UNDECIDED)
        })
    });
    let least = outcome.settings.least_whole_gain;
    let is_open = |cause: &&WholeCause| {
        !cause.is_named && cause.gain.part >= least && named.iter().all(|cause| cause.joint != 0)
    };
    let whole = outcome
        .whole
        .iter()
        .filter(is_open)
        .map(|cause| alternative(cause.fit.effect.name(), 0, 0.3, cause.taken.share, WEIGHT));
    joint.chain(undecided).chain(whole).collect()
}

const UNCONFIRMED: &str = "the logs that confirm do not show it in both halves";
const UNDECIDED: &str = "another effect does the same";
const WEIGHT: &str =
    "gravity's scales, joint by joint, their friction, or another effect of the arm do the same";

fn alternative(effect: &str, joint: usize, probability: f64, share: f64, why: &str) -> Alternative {
    Alternative {
        effect: effect.to_owned(),
        joint: joint as u8,
        probability,
        confidence: probability,
        instead_of: None,
        share,
        why: Some(why.to_owned()),
    }
}

/// The verdict in one word.
fn verdict(outcome: &Outcome, causes: &[Cause], gap: &Gap) -> Verdict {
    let times = outcome.settings.gap_by_noise;
    let floor = noise(&outcome.arm).into_iter().map(f64::sqrt);
    let small = outcome.settings.small_gap_rad;
    let limits: Vec<f64> = floor.map(|floor| (times * floor).max(small)).collect();
    let within = |left: &[f64]| left.iter().zip(&limits).all(|(left, limit)| left <= limit);
    match (causes.is_empty(), within(&gap.refitted_rad), within(&gap.with_effects_rad)) {
        (true, true, _) => Verdict::None,
        (true, false, _) => Verdict::Unknown,
        (false, _, true) => Verdict::Effect,
        (false, ..) => Verdict::Partial,
    }
}

fn data(outcome: &Outcome) -> DataParts {
    let files = |role: Role| {
        let logs = outcome.prepared.logs.iter().filter(|log| log.record.role == role);
        let mut files: Vec<String> = logs.map(|log| log.record.file.clone()).collect();
        files.dedup();
        files
    };
    DataParts { fit: files(Role::Train), select: files(Role::Train), confirm: files(Role::Holdout) }
}
