//! What the refit moved, in words.

use super::figures::{MOST_SAID, joint_numbers, largest_excess, size};
use crate::report::words::{change_words, joint_of, model_parameter_words, percent};
use crate::result::{Diagnosis, ParameterChange, Verdict};

/// Share of what refitting gains from which a parameter is said.
const SAID_PARAMETER: f64 = 0.2;

/// Parameters that take a good part of what refitting gains, where that is much.
pub(super) fn refitted(diagnosis: &Diagnosis) -> Option<String> {
    let (report, least) = (&diagnosis.report, diagnosis.criteria.verdict.worth_refitting);
    let mut joints = report.gap.as_given_v.iter().zip(&report.gap.refitted_v);
    let is_worth = joints.any(|(given_v, refitted_v)| *given_v > least * refitted_v);
    let large = report.parameters_changed.iter().filter(|c| c.share >= SAID_PARAMETER);
    let words = |(index, change): (usize, &ParameterChange)| {
        let (place, name) = model_parameter_words(&change.parameter);
        let of = if index == 0 { " of what refitting gains" } else { "" };
        let changed = diagnosis.units_of(joint_of(&place)).in_words(&change_words(change));
        format!("{place}, {name} {changed}: {} %{of}", percent(change.share))
    };
    let said: Vec<String> = large.take(MOST_SAID).enumerate().map(words).collect();
    match said.as_slice() {
        _ if !is_worth => None,
        [] => by_many(diagnosis),
        said => Some(format!("Model refitted: {}.", said.join("; "))),
    }
}

/// What refitting gains where no parameter takes a good part of it; said already where there is
/// no gap.
fn by_many(diagnosis: &Diagnosis) -> Option<String> {
    let gap = &diagnosis.report.gap;
    let (index, _) = largest_excess(&gap.as_given_v, &gap.refitted_v)?;
    let joint = *joint_numbers(diagnosis).get(index)?;
    let of_joint = |value: f64| size(diagnosis, joint, value);
    let (from, to) = (of_joint(gap.as_given_v[index]), of_joint(gap.refitted_v[index]));
    let is_said = diagnosis.report.verdict == Verdict::None;
    (!is_said).then(|| {
        format!("Model refitted: many parameters together take joint {joint} from {from} to {to}.")
    })
}
