//! The tables of a diagnosis.

use super::units::are_common;
use crate::Page;
use diagnosis::quantity::{quantity, split_unit};
use diagnosis::report::sentence::joint_numbers;
use diagnosis::report::words::{
    axis_words, change_words, effect_words, joint_of, model_parameter_words, parameter_words,
    parameters_with_intervals, percent,
};
use diagnosis::{Alternative, Cause, Detectable, Diagnosis, ParameterChange, Remainder, Rival};

/// The header of [`cause_rows`].
pub const CAUSES: [&str; 6] =
    ["cause", "joint", "share of the gap", "probability", "shrinkage", "parameters"];

/// A row per cause.
pub fn cause_rows(diagnosis: &Diagnosis) -> Vec<Vec<String>> {
    let row = |cause: &Cause| {
        vec![
            effect_words(&cause.effect),
            joint_number(cause.joint),
            with_interval(cause.share, cause.share_interval),
            percent_words(cause.probability),
            with_interval(cause.shrinkage, cause.shrinkage_interval),
            diagnosis
                .units_of(cause.joint)
                .in_words(&parameters_with_intervals(&diagnosis.catalogue, cause)),
        ]
    };
    diagnosis.report.causes.iter().map(row).collect()
}

fn with_interval(part: f64, interval: [f64; 2]) -> String {
    let [low, high] = interval.map(percent);
    format!("{} [{low} to {high}]", percent_words(part))
}

/// "4 %".
pub(super) fn percent_words(part: f64) -> String {
    format!("{} %", percent(part))
}

fn joint_number(joint: u8) -> String {
    if joint == 0 { "all".into() } else { joint.to_string() }
}

/// Adds the tables below the pictures; those without rows are left out.
pub(super) fn add(page: &mut Page, diagnosis: &Diagnosis) {
    let report = &diagnosis.report;
    let words = |page: &mut Page, heading: &str, header: &[&str], rows: Vec<Vec<String>>| {
        if !rows.is_empty() {
            page.heading(heading).words(header, &rows);
        }
    };
    words(page, "Where the gap lies, before any cause", &PLACES, place_rows(diagnosis));
    let header = gap_header(diagnosis);
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    page.heading("The gap on the logs that chose nothing, rms")
        .table(&header, &gap_rows(diagnosis));
    words(page, "Rivals, and why they lost", &RIVALS, rival_rows(diagnosis));
    words(
        page,
        "Not ruled out, or found and not named",
        &ALTERNATIVES,
        alternative_rows(diagnosis),
    );
    words(page, "What these logs cannot show", &UNTESTABLE, untestable_rows(diagnosis));
    words(
        page,
        "The smallest that these logs would have shown",
        &detectable_header(diagnosis),
        detectable_rows(diagnosis),
    );
    if !report.remarks.is_empty() {
        page.heading("Remarks").list(&report.remarks);
    }
}

/// The header of [`parameter_rows`].
pub(super) const PARAMETERS: [&str; 6] =
    ["parameter", "", "given", "found, 95 % interval", "change", "share of the refit"];

/// A row per parameter that the refit moved.
pub(super) fn parameter_rows(diagnosis: &Diagnosis) -> Vec<Vec<String>> {
    let row = |change: &ParameterChange| {
        let unit = split_unit(&change.parameter).1;
        let (place, name) = model_parameter_words(&change.parameter);
        let units = diagnosis.units_of(joint_of(&place));
        let quantity = |value: f64, unit: &str| units.in_words(&quantity(value, unit));
        let [low, high] = change.interval.map(|end| quantity(end, unit));
        vec![
            format!("{place}, {name}"),
            change.parameter.clone(),
            if change.is_given { quantity(change.given, unit) } else { String::new() },
            format!("{} [{low} to {high}]", quantity(change.found, unit)),
            match change.is_given {
                true => units.in_words(&change_words(change)),
                false => "the model does not tell it".into(),
            },
            percent_words(change.share),
        ]
    };
    diagnosis.report.parameters_changed.iter().map(row).collect()
}

/// The header of [`remainder_rows`].
pub(super) const REMAINDER: [&str; 6] =
    ["joint", "over", "rms", "share of the gap", "how", "nearest effect"];

/// A row per entry of what no cause explains.
pub(super) fn remainder_rows(diagnosis: &Diagnosis) -> Vec<Vec<String>> {
    let row = |entry: &Remainder| {
        vec![
            entry.joint.to_string(),
            axis_words(entry.axis).into(),
            diagnosis.units_of(entry.joint).in_words(&quantity(entry.rms_v, "V")),
            percent_words(entry.share),
            entry.detail.clone(),
            entry.nearest.as_deref().map_or_else(String::new, effect_words),
        ]
    };
    diagnosis.report.remainder.iter().map(row).collect()
}

const PLACES: [&str; 4] = ["joint", "varies with", "share of the gap", "how"];

fn place_rows(diagnosis: &Diagnosis) -> Vec<Vec<String>> {
    let shares = diagnosis.report.gap_shares.iter();
    let row = shares.map(|share| {
        vec![
            share.joint.to_string(),
            axis_words(share.axis).into(),
            format!("{} %", percent(share.share)),
            share.detail.clone(),
        ]
    });
    row.collect()
}

/// Columns of the gap, with the units of a joint that turns and takes volts.
const GAP: [(&str, &str); 7] = [
    ("as given", "mV"),
    ("refitted", "mV"),
    ("with effects", "mV"),
    ("with tables", "mV"),
    ("noise", "mV"),
    ("refitted", "mrad"),
    ("with effects", "mrad"),
];

/// The columns' names, with their units where those of all joints are the same.
fn gap_header(diagnosis: &Diagnosis) -> Vec<String> {
    let units = diagnosis.units_of(joint_numbers(diagnosis).first().copied().unwrap_or(0));
    let common = are_common(diagnosis);
    let column = |(name, unit): (&str, &str)| match common {
        true => format!("{name} [{}]", units.in_words(unit)),
        false => name.into(),
    };
    std::iter::once("Joint".into()).chain(GAP.map(column)).collect()
}

/// A row per joint; numbers have their units where those of joints differ.
fn gap_rows(diagnosis: &Diagnosis) -> Vec<Vec<String>> {
    let gap = &diagnosis.report.gap;
    let columns = [
        (&gap.as_given_v, 2),
        (&gap.refitted_v, 2),
        (&gap.with_effects_v, 2),
        (&gap.with_tables_v, 2),
        (&gap.noise_floor_v, 2),
        (&gap.refitted_rad, 3),
        (&gap.with_effects_rad, 3),
    ];
    let differ = !are_common(diagnosis);
    let cell =
        |index: usize, joint: u8, (values, digits): (&Vec<f64>, usize), unit: &str| match values
            .get(index)
            .filter(|value| value.is_finite())
        {
            Some(value) if differ => {
                format!("{:.digits$} {}", 1e3 * value, diagnosis.units_of(joint).in_words(unit))
            }
            Some(value) => format!("{:.digits$}", 1e3 * value),
            None => "-".into(),
        };
    let row = |(index, joint): (usize, u8)| {
        let cells = columns.iter().zip(GAP);
        let cells = cells.map(|(column, (_, unit))| cell(index, joint, *column, unit));
        std::iter::once(joint.to_string()).chain(cells).collect()
    };
    joint_numbers(diagnosis).into_iter().enumerate().map(row).collect()
}

const RIVALS: [&str; 5] = ["effect", "joint", "explains", "why it lost", "best parameters"];

fn rival_rows(diagnosis: &Diagnosis) -> Vec<Vec<String>> {
    let row = |rival: &Rival| {
        vec![
            effect_words(&rival.effect),
            joint_number(rival.joint),
            format!("{} %", percent(rival.explained)),
            rival.why.clone(),
            diagnosis.units_of(rival.joint).in_words(&parameter_words(
                &diagnosis.catalogue,
                &rival.effect,
                &rival.parameters,
                true,
            )),
        ]
    };
    diagnosis.rivals.iter().map(row).collect()
}

const ALTERNATIVES: [&str; 5] =
    ["effect", "joint", "probability", "share of the gap", "in place of, or why not named"];

fn alternative_rows(diagnosis: &Diagnosis) -> Vec<Vec<String>> {
    let report = &diagnosis.report;
    let row = |other: &Alternative| {
        let cause = other.instead_of.and_then(|index| report.causes.get(index));
        vec![
            effect_words(&other.effect),
            joint_number(other.joint),
            percent_words(other.probability),
            percent_words(other.share),
            cause.map_or_else(
                || other.why.clone().unwrap_or_default(),
                |cause| effect_words(&cause.effect),
            ),
        ]
    };
    report.alternatives.iter().map(row).collect()
}

const UNTESTABLE: [&str; 3] = ["effect", "joint", "why, and what would show it"];

fn untestable_rows(diagnosis: &Diagnosis) -> Vec<Vec<String>> {
    let all = diagnosis.report.untestable.iter();
    all.map(|u| vec![effect_words(&u.effect), joint_number(u.joint), u.why.clone()]).collect()
}

/// Names of the columns for joints, as many as an arm may have.
const JOINTS: [&str; 10] = [
    "joint 1", "joint 2", "joint 3", "joint 4", "joint 5", "joint 6", "joint 7", "joint 8",
    "joint 9", "joint 10",
];

/// Joints that have a column: three at least.
fn columns(diagnosis: &Diagnosis) -> u8 {
    joint_numbers(diagnosis).into_iter().max().unwrap_or(0).clamp(3, JOINTS.len() as u8)
}

fn detectable_header(diagnosis: &Diagnosis) -> Vec<&'static str> {
    let joints = &JOINTS[..usize::from(columns(diagnosis))];
    [&["effect"], joints, &["whole robot"]].concat()
}

/// A row per effect, a column per joint.
fn detectable_rows(diagnosis: &Diagnosis) -> Vec<Vec<String>> {
    let all = &diagnosis.report.detectable;
    let mut effects: Vec<&str> = Vec::new();
    for one in all {
        if !effects.contains(&one.effect.as_str()) {
            effects.push(&one.effect);
        }
    }
    let cell = |effect: &str, joint: u8| {
        let found = all.iter().find(|d| d.effect == effect && d.joint == joint);
        found.map_or_else(String::new, |one| diagnosis.units_of(joint).in_words(&size_words(one)))
    };
    let row = |effect: &str| {
        let cells = (1..=columns(diagnosis)).chain([0]).map(|joint| cell(effect, joint));
        std::iter::once(effect_words(effect)).chain(cells).collect()
    };
    effects.into_iter().map(row).collect()
}

fn size_words(one: &Detectable) -> String {
    match split_unit(&one.parameter) {
        (_, "") => format!("{:.1} %", 100.0 * one.size),
        (_, unit) => quantity(one.size, unit),
    }
}
