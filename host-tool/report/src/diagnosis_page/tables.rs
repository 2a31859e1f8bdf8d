//! The tables of a diagnosis.

use crate::Page;
use diagnosis::quantity::{quantity, split_unit};
use diagnosis::report::sentence::{axis_words, effect_words, joint_numbers, parameter_words};
use diagnosis::{Cause, Detectable, Diagnosis, Rival};

/// The header of [`cause_rows`].
pub const CAUSES: [&str; 5] = ["cause", "joint", "confidence", "shrinkage", "parameters"];

/// A row per cause.
pub fn cause_rows(diagnosis: &Diagnosis) -> Vec<Vec<String>> {
    let row = |cause: &Cause| {
        let [low, high] = cause.shrinkage_interval.map(percent);
        vec![
            effect_words(&cause.effect),
            joint_number(cause.joint),
            format!("{} %", percent(cause.confidence)),
            format!("{} % ({low} to {high})", percent(cause.shrinkage)),
            parameter_words(&diagnosis.catalogue, &cause.effect, &cause.parameters, true),
        ]
    };
    diagnosis.report.causes.iter().map(row).collect()
}

fn percent(part: f64) -> String {
    format!("{:.0}", 100.0 * part)
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
    words(page, "Where the gap lies", &PLACES, place_rows(diagnosis));
    page.heading("The gap on the logs held out, rms").table(&GAP, &gap_rows(diagnosis));
    words(page, "Rivals, and why they lost", &RIVALS, rival_rows(diagnosis));
    words(page, "Not ruled out", &ALTERNATIVES, alternative_rows(diagnosis));
    words(page, "What these logs cannot show", &UNTESTABLE, untestable_rows(diagnosis));
    words(
        page,
        "The smallest that these logs would have shown",
        &DETECTABLE,
        detectable_rows(&report.detectable),
    );
    if !report.remarks.is_empty() {
        page.heading("Remarks").list(&report.remarks);
    }
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

const GAP: [&str; 7] = [
    "Joint",
    "as given [mV]",
    "refitted [mV]",
    "with effects [mV]",
    "noise [mV]",
    "refitted [mrad]",
    "with effects [mrad]",
];

fn gap_rows(diagnosis: &Diagnosis) -> Vec<Vec<String>> {
    let gap = &diagnosis.report.gap;
    let columns = [
        (&gap.as_given_v, 2),
        (&gap.refitted_v, 2),
        (&gap.with_effects_v, 2),
        (&gap.noise_floor_v, 2),
        (&gap.refitted_rad, 3),
        (&gap.with_effects_rad, 3),
    ];
    let cell = |index: usize, (values, digits): &(&Vec<f64>, usize)| match values.get(index) {
        Some(value) if value.is_finite() => format!("{:.digits$}", 1e3 * value),
        _ => "-".into(),
    };
    let row = |(index, joint): (usize, u8)| {
        let cells = columns.iter().map(|column| cell(index, column));
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
            parameter_words(&diagnosis.catalogue, &rival.effect, &rival.parameters, true),
        ]
    };
    diagnosis.rivals.iter().map(row).collect()
}

const ALTERNATIVES: [&str; 3] = ["effect", "joint", "confidence"];

fn alternative_rows(diagnosis: &Diagnosis) -> Vec<Vec<String>> {
    let others = diagnosis.report.alternatives.iter();
    let row = others.map(|other| {
        let confidence = format!("{} %", percent(other.confidence));
        vec![effect_words(&other.effect), joint_number(other.joint), confidence]
    });
    row.collect()
}

const UNTESTABLE: [&str; 3] = ["effect", "joint", "why, and what would show it"];

fn untestable_rows(diagnosis: &Diagnosis) -> Vec<Vec<String>> {
    let all = diagnosis.report.untestable.iter();
    all.map(|u| vec![effect_words(&u.effect), joint_number(u.joint), u.why.clone()]).collect()
}

const DETECTABLE: [&str; 5] = ["effect", "joint 1", "joint 2", "joint 3", "whole robot"];

/// A row per effect, a column per joint.
fn detectable_rows(all: &[Detectable]) -> Vec<Vec<String>> {
    let mut effects: Vec<&str> = Vec::new();
    for one in all {
        if !effects.contains(&one.effect.as_str()) {
            effects.push(&one.effect);
        }
    }
    let cell = |effect: &str, joint: u8| {
        let found = all.iter().find(|d| d.effect == effect && d.joint == joint);
        found.map_or_else(String::new, size_words)
    };
    let row = |effect: &str| {
        let cells = [1, 2, 3, 0].map(|joint| cell(effect, joint));
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
