//! The causes in words, and what else they may be.

use super::refit::refitted;
use super::{MOST_SAID, SAID_NEAREST, joint_numbers};
use crate::report::remaining_words::{remaining, rest_part};
use crate::report::words::{
    capitalised, certainty_words, effect_words, joint_words, parameter_words, percent,
};
use crate::result::{Alternative, Cause, Diagnosis};

/// Causes by share, what else they may be, what the refit moved, and what remains.
pub(super) fn named(diagnosis: &Diagnosis) -> String {
    let report = &diagnosis.report;
    let mut parts: Vec<String> =
        report.causes.iter().map(|cause| cause_words(diagnosis, cause)).collect();
    parts.extend(not_ruled_out(diagnosis));
    parts.extend(not_named(diagnosis));
    parts.extend(refitted(diagnosis));
    parts.extend(remaining(&report.remainder, rest_part(&report.gap)));
    parts.join(" ")
}

fn cause_words(diagnosis: &Diagnosis, cause: &Cause) -> String {
    let parameters = parameter_words(&diagnosis.catalogue, &cause.effect, &cause.parameters, false);
    let parameters = diagnosis.units_of(cause.joint).in_words(&parameters);
    let alone = cause.joint == 0 || joint_numbers(diagnosis).len() == 1;
    let [low, high] = cause.share_interval.map(percent);
    let words: Vec<String> = [effect_words(&cause.effect), parameters]
        .into_iter()
        .filter(|words| !words.is_empty())
        .collect();
    format!(
        "{}: {}: {} % of {} gap [{low} to {high}], {}.",
        capitalised(&joint_words(cause.joint)),
        words.join(", "),
        percent(cause.share),
        if alone { "the" } else { "its" },
        certainty_words(cause.probability)
    )
}

/// What could stand in the place of a cause.
fn not_ruled_out(diagnosis: &Diagnosis) -> Option<String> {
    let report = &diagnosis.report;
    let words = |other: &Alternative| {
        let cause = report.causes.get(other.instead_of?)?;
        let (effect, joint) = (effect_words(&other.effect), joint_words(other.joint));
        let place = effect_words(&cause.effect);
        Some(format!("{effect} on {joint} in place of {place} ({} %)", percent(other.probability)))
    };
    let said: Vec<String> = report.alternatives.iter().filter_map(words).take(MOST_SAID).collect();
    (!said.is_empty()).then(|| format!("Not ruled out: {}.", said.join("; ")))
}

/// What was found besides and is not named, the likeliest first, and why.
pub(super) fn not_named(diagnosis: &Diagnosis) -> Option<String> {
    let is_said = |other: &&Alternative| other.instead_of.is_none() && other.share >= SAID_NEAREST;
    let mut others: Vec<_> = diagnosis.report.alternatives.iter().filter(is_said).collect();
    others.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    let words = |other: &&Alternative| {
        let (effect, joint) = (effect_words(&other.effect), joint_words(other.joint));
        let why = other.why.as_ref().map_or_else(String::new, |why| format!(" ({why})"));
        format!("{effect} on {joint}, {} %{why}", percent(other.share))
    };
    let said: Vec<String> = others.iter().take(MOST_SAID).map(words).collect();
    (!said.is_empty()).then(|| format!("Found, but not named: {}.", said.join("; ")))
}
