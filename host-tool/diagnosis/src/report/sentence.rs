//! A diagnosis in a few sentences.

use super::remaining_words::{along, remaining, rest_part};
use super::words::{
    axis_words, capitalised, certainty_words, change_words, joint_of, model_parameter_words,
    parameter_words, percent,
};
pub use super::words::{effect_words, joint_words};
use crate::quantity::volts;
use crate::result::{
    Alternative, Cause, Diagnosis, GapShare, ModelFaultFound, ParameterChange, Rival, Verdict,
};

/// Most alternatives and parameters that are said.
const MOST_SAID: usize = 2;
/// Share of what refitting gains from which a parameter is said.
const SAID_PARAMETER: f64 = 0.2;
/// Share of the gap from which what came nearest is said.
const SAID_NEAREST: f64 = 0.01;

/// What a person must know and can act on.
pub fn sentence(diagnosis: &Diagnosis) -> String {
    if let Some(fault) = &diagnosis.report.model_fault {
        return at_fault(diagnosis, fault);
    }
    match diagnosis.report.verdict {
        Verdict::Effect | Verdict::Partial => named(diagnosis),
        Verdict::None => no_gap(diagnosis),
        Verdict::Unknown => unexplained(diagnosis),
    }
}

/// What is wrong with the model itself.
fn at_fault(diagnosis: &Diagnosis, fault: &ModelFaultFound) -> String {
    let (gap, joints) = (&diagnosis.report.gap, joint_numbers(diagnosis));
    let largest = largest_excess(&gap.refitted_v, &gap.noise_floor_v);
    let of_joint = largest.and_then(|(index, excess_v)| Some((joints.get(index)?, excess_v)));
    let size = of_joint.map_or_else(String::new, |(joint, excess_v)| {
        format!(" of {} on joint {joint}", size(diagnosis, *joint, excess_v))
    });
    format!(
        "The model is not that of this robot: {}. That explains {} % of the gap{size}, and no \
         cause is named until it is put right.",
        fault.what,
        percent(fault.explained)
    )
}

/// The rig's joints, 1 to 3, in the order in which the gap is given.
pub fn joint_numbers(diagnosis: &Diagnosis) -> Vec<u8> {
    match diagnosis.logs.first() {
        Some(log) => log.joints.iter().map(|joint| joint.joint).collect(),
        None => (1..=diagnosis.report.gap.refitted_v.len() as u8).collect(),
    }
}

/// Causes by share, what else they may be, what the refit moved, and what remains.
fn named(diagnosis: &Diagnosis) -> String {
    let report = &diagnosis.report;
    let mut parts: Vec<String> =
        report.causes.iter().map(|cause| cause_words(diagnosis, cause)).collect();
    parts.extend(not_ruled_out(diagnosis));
    parts.extend(not_confirmed(diagnosis));
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

/// What takes a part of the gap besides, but not surely enough to be named.
fn not_confirmed(diagnosis: &Diagnosis) -> Option<String> {
    let others = diagnosis.report.alternatives.iter();
    let is_said = |other: &&Alternative| other.instead_of.is_none() && other.share >= SAID_NEAREST;
    let words = |other: &Alternative| {
        let (effect, joint) = (effect_words(&other.effect), joint_words(other.joint));
        format!("{effect} on {joint}, {} %", percent(other.share))
    };
    let said: Vec<String> = others.filter(is_said).take(MOST_SAID).map(words).collect();
    (!said.is_empty()).then(|| format!("Besides, not confirmed: {}.", said.join("; ")))
}

/// Parameters that take a good part of what refitting gains, where that is much.
fn refitted(diagnosis: &Diagnosis) -> Option<String> {
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

fn no_gap(diagnosis: &Diagnosis) -> String {
    let parts: Vec<String> =
        [Some(no_gap_left(diagnosis)), refitted(diagnosis)].into_iter().flatten().collect();
    parts.join(" ")
}

fn no_gap_left(diagnosis: &Diagnosis) -> String {
    let gap = &diagnosis.report.gap;
    let joints = joint_numbers(diagnosis);
    let largest = largest_excess(&gap.refitted_v, &gap.noise_floor_v);
    let (Some((index, _)), true) = (largest, gap.as_given_v.len() == gap.refitted_v.len()) else {
        return "No gap above the noise.".into();
    };
    let joint = joints.get(index).copied().unwrap_or(0);
    let (given_v, left_v) = (gap.as_given_v[index], gap.refitted_v[index]);
    let of_joint = |value: f64| size(diagnosis, joint, value);
    let floor = of_joint(gap.noise_floor_v[index]);
    if given_v > diagnosis.criteria.verdict.worth_refitting * left_v {
        let (given, left) = (of_joint(given_v), of_joint(left_v));
        return format!(
            "No gap above the noise once the model is refitted: that takes joint {joint} from \
             {given} to {left}, where noise alone leaves {floor}."
        );
    }
    let left = of_joint(left_v);
    format!("No gap above the noise: {left} are left on joint {joint}, noise alone leaves {floor}.")
}

/// Where the gap lies, and what came nearest.
fn unexplained(diagnosis: &Diagnosis) -> String {
    let report = &diagnosis.report;
    let largest = largest_excess(&report.gap.refitted_v, &report.gap.noise_floor_v);
    let joints = joint_numbers(diagnosis);
    let place = largest.and_then(|(index, excess_v)| Some((*joints.get(index)?, excess_v)));
    let Some((joint, excess_v)) = place else {
        return "A gap that nothing in the catalogue explains.".into();
    };
    let share = report.gap_shares.iter().find(|share| share.joint == joint);
    let mut parts = vec![format!(
        "A gap of {} on joint {joint} that nothing in the catalogue explains{}.",
        size(diagnosis, joint, excess_v),
        share.map_or_else(String::new, |share| {
            format!("; {}, {} % of the gap", varies(share), percent(share.share))
        })
    )];
    parts.extend(elsewhere(&report.gap_shares, share));
    parts.extend(nearest(diagnosis, joint));
    parts.extend(refitted(diagnosis));
    parts.join(" ")
}

/// Where else the gap lies.
fn elsewhere(shares: &[GapShare], said: Option<&GapShare>) -> Option<String> {
    let others = shares.iter().filter(|share| Some(*share) != said).take(MOST_SAID);
    let words = |share: &GapShare| {
        format!("{}, {} %", along(share.joint, share.axis, &share.detail), percent(share.share))
    };
    let others: Vec<String> = others.map(words).collect();
    (!others.is_empty()).then(|| format!("Elsewhere: {}.", others.join("; ")))
}

/// The effect on a joint that takes most of its gap, and what it lacks.
fn nearest(diagnosis: &Diagnosis, joint: u8) -> Option<String> {
    let on_joint = |rival: &&Rival| [0, joint].contains(&rival.joint);
    let rival = diagnosis.rivals.iter().find(on_joint)?;
    let parameters = parameter_words(&diagnosis.catalogue, &rival.effect, &rival.parameters, false);
    let parameters = diagnosis.units_of(rival.joint).in_words(&parameters);
    (rival.explained >= SAID_NEAREST).then(|| {
        format!(
            "Nearest: {} on {}, {parameters}, would take {} %, but {}.",
            effect_words(&rival.effect),
            joint_words(rival.joint),
            percent(rival.explained),
            rival.why
        )
    })
}

/// "it varies with position: order 8 per revolution", or what the detail says by itself.
fn varies(share: &GapShare) -> String {
    let detail = &share.detail;
    let begins = |words: &[&str]| words.iter().any(|word| detail.starts_with(word));
    if begins(&["varies", "grows", "falls"]) {
        format!("it {detail}")
    } else if begins(&["proportional", "even", "odd", "constant"]) {
        format!("it is {detail}")
    } else {
        format!("it varies with {}: {detail}", axis_words(share.axis))
    }
}

/// A residual in the unit of its joint.
fn size(diagnosis: &Diagnosis, joint: u8, value: f64) -> String {
    diagnosis.units_of(joint).in_words(&volts(value))
}

/// Where the square lies most above the floor's, and the root of that excess.
fn largest_excess(left_v: &[f64], floor_v: &[f64]) -> Option<(usize, f64)> {
    let squares = left_v.iter().zip(floor_v).map(|(left, floor)| left * left - floor * floor);
    let largest = squares.enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
    Some((largest.0, largest.1.max(0.0).sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::{cogging, diagnosis, more_viscous, payload, slow_friction};

    #[test]
    fn a_part_with_a_name_is_said_with_its_rest() {
        let mut partial = diagnosis(Verdict::Partial, vec![payload(), cogging()], |_| 0.0);
        partial.report.remainder = vec![slow_friction()];
        partial.report.parameters_changed = vec![more_viscous()];
        let gap = &mut partial.report.gap;
        gap.noise_floor_v = vec![1e-3; 3];
        gap.as_given_v = vec![0.2; 3];
        gap.refitted_v = vec![0.1; 3];
        gap.with_effects_v = vec![0.02; 3];
        let said = sentence(&partial);
        assert_eq!(
            said,
            "Whole robot: payload, 0.42 kg: 94 % of the gap [92 to 96], sure (98 %). \
             Joint 3: cogging, 8 per turn, 0.11 V: 95 % of its gap [93 to 96], sure (97 %). \
             Model refitted: joint 2, viscous friction +18 %: 60 % of what refitting gains. \
             The rest, 4 %: joint 2 over velocity, friction below 0.02 rad/s."
        );
    }

    #[test]
    fn what_may_stand_in_place_of_a_cause_is_said() {
        let mut found = diagnosis(Verdict::Effect, vec![cogging()], |_| 0.0);
        found.report.alternatives.push(Alternative {
            effect: "torque_ripple".into(),
            joint: 3,
            probability: 0.12,
            confidence: 0.12,
            instead_of: Some(0),
            share: 0.9,
            why: None,
        });
        let said = sentence(&found);
        let words = "Not ruled out: torque ripple on joint 3 in place of cogging (12 %).";
        assert!(said.contains(words), "{said}");
        let other = &mut found.report.alternatives[0];
        (other.instead_of, other.share) = (None, 0.03);
        let said = sentence(&found);
        assert!(said.contains("Besides, not confirmed: torque ripple on joint 3, 3 %."), "{said}");
    }

    #[test]
    fn a_refit_of_many_parameters_is_said_by_what_it_gains() {
        let mut unknown = diagnosis(Verdict::Unknown, vec![], |at| 0.05 * at.qd);
        unknown.report.gap.as_given_v = vec![0.01, 0.081, 0.1];
        unknown.report.gap.refitted_v = vec![0.01, 0.0148, 0.09];
        let words = "Model refitted: many parameters together take joint 2 from 81 mV to 14.8 mV.";
        assert!(sentence(&unknown).ends_with(words), "{}", sentence(&unknown));
    }

    #[test]
    fn the_unknown_is_said_with_what_came_nearest() {
        let unknown = diagnosis(Verdict::Unknown, vec![], |at| 0.05 * at.qd);
        let said = sentence(&unknown);
        assert!(said.contains("on joint 3 that nothing in the catalogue explains; it "), "{said}");
        let nearest =
            "Nearest: torque ripple on joint 3, 8 per turn, +8.0 %, would take 41 %, but ";
        assert!(said.contains(nearest), "{said}");
    }
}
