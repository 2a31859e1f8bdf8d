//! What takes which share: causes of the gap, and parameters of what refitting gains.

use super::tables::percent_words;
use crate::{ShareBars, ShareRow};
use diagnosis::quantity::{quantity, split_unit};
use diagnosis::report::remaining_words::rest_part;
use diagnosis::report::sentence::joint_numbers;
use diagnosis::report::words::{
    certainty_words, change_words, effect_words, joint_of, joint_words, model_parameter_words,
};
use diagnosis::{Cause, Diagnosis, ParameterChange};

/// What the picture of causes shows.
pub(super) const CAPTION: &str = "Part of the gap's squares above the noise that goes when the \
    cause is added, on logs that chose nothing; the line is its 95 % interval.";
/// What the picture of parameters shows.
pub(super) const REFIT_CAPTION: &str =
    "Part of the squares between the model as given and refitted.";

const CAUSE: &str = "#0072b2";
const REST: &str = "#9a9a9a";
const PARAMETER: &str = "#d55e00";

/// A bar per cause, and one for the rest; `None` where nothing is named.
pub(super) fn causes(diagnosis: &Diagnosis) -> Option<ShareBars> {
    let report = &diagnosis.report;
    let alone = joint_numbers(diagnosis).len() == 1;
    let mut rows: Vec<ShareRow> =
        report.causes.iter().map(|cause| cause_row(cause, alone)).collect();
    let rest = rest_part(&report.gap);
    rows.push(ShareRow {
        name: "the rest, all joints".into(),
        share: rest,
        interval: None,
        note: format!("{} of the gap", percent_words(rest)),
        colour: REST,
    });
    (rows.len() > 1).then_some(ShareBars { rows })
}

fn cause_row(cause: &Cause, alone: bool) -> ShareRow {
    let joint = joint_words(cause.joint);
    let whole = if alone || cause.joint == 0 { "the gap".into() } else { format!("{joint}'s gap") };
    let share = percent_words(cause.share);
    ShareRow {
        name: format!("{}, {joint}", effect_words(&cause.effect)),
        share: cause.share,
        interval: Some(cause.share_interval),
        note: format!("{share} of {whole}, {}", certainty_words(cause.probability)),
        colour: CAUSE,
    }
}

/// A bar per parameter that the refit moved; `None` where it moved none.
pub(super) fn parameters(diagnosis: &Diagnosis) -> Option<ShareBars> {
    let row = |change: &ParameterChange| {
        let (place, name) = model_parameter_words(&change.parameter);
        let words = match change.is_given {
            true => change_words(change),
            false => quantity(change.found, split_unit(&change.parameter).1) + " (not given)",
        };
        let said = diagnosis.units_of(joint_of(&place)).in_words(&words);
        ShareRow {
            name: format!("{place}, {name}"),
            share: change.share,
            interval: None,
            note: format!("{said}, {} of the refit", percent_words(change.share)),
            colour: PARAMETER,
        }
    };
    let rows: Vec<ShareRow> = diagnosis.report.parameters_changed.iter().map(row).collect();
    (!rows.is_empty()).then_some(ShareBars { rows })
}
