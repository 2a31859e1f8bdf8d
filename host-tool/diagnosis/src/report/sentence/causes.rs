//! The causes in words, and what else they may be.

use super::figures::{LEAST_SAID_SHARE, MOST_SAID, joint_numbers};
use super::refit::refitted;
use crate::report::remaining_words::{remaining, rest_part};
use crate::report::words::{
    capitalised, certainty_words, effect_words, joint_words, percent, told_parameters,
};
use crate::result::{Alternative, Cause, Diagnosis};

/// Causes by share, what else they may be, what the refit moved, and what remains.
pub(super) fn named(diagnosis: &Diagnosis) -> String {
    let report = &diagnosis.report;
    let mut parts: Vec<String> =
        report.causes.iter().map(|cause| cause_words(diagnosis, cause)).collect();
    parts.extend(not_ruled_out(diagnosis));
    parts.extend(not_named(diagnosis, &found_not_named(diagnosis)));
    parts.extend(refitted(diagnosis));
    parts.extend(remaining(&report.remainder, rest_part(&report.gap)));
    parts.join(" ")
}

fn cause_words(diagnosis: &Diagnosis, cause: &Cause) -> String {
    let parameters = told_parameters(&diagnosis.catalogue, cause);
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

/// What was found and is not named, the likeliest first, as many as are said.
pub(super) fn found_not_named(diagnosis: &Diagnosis) -> Vec<&Alternative> {
    let is_said =
        |other: &&Alternative| other.instead_of.is_none() && other.share >= LEAST_SAID_SHARE;
    diagnosis.report.alternatives.iter().filter(is_said).take(MOST_SAID).collect()
}

/// These in words, and why they are not named.
pub(super) fn not_named(diagnosis: &Diagnosis, found: &[&Alternative]) -> Option<String> {
    let alone = joint_numbers(diagnosis).len() == 1;
    let words = |other: &&Alternative| {
        let (effect, joint) = (effect_words(&other.effect), joint_words(other.joint));
        let whose = if alone || other.joint == 0 { "the" } else { "its" };
        let why = other.why.as_ref().map_or_else(String::new, |why| format!(" ({why})"));
        format!("{effect} on {joint}, {} % of {whose} gap{why}", percent(other.share))
    };
    let said: Vec<String> = found.iter().map(words).collect();
    (!said.is_empty()).then(|| format!("Found, but not named: {}.", said.join("; ")))
}
