//! A diagnosis in one sentence, and effects in words.

use crate::quantity::{number, quantity, split_unit, volts};
use crate::result::{Axis, Cause, Diagnosis, GapShare, Value, Verdict};
use rig::effects::{Catalogue, Kind, Parameter};

use std::collections::BTreeMap;

/// What a person must know and can act on.
pub fn sentence(diagnosis: &Diagnosis) -> String {
    match diagnosis.report.verdict {
        Verdict::Effect | Verdict::Partial => named(diagnosis),
        Verdict::None => no_gap(diagnosis),
        Verdict::Unknown => unexplained(diagnosis),
    }
}

/// The rig's joints, 1 to 3, in the order in which the gap is given.
pub fn joint_numbers(diagnosis: &Diagnosis) -> Vec<u8> {
    match diagnosis.logs.first() {
        Some(log) => log.joints.iter().map(|joint| joint.joint).collect(),
        None => (1..=diagnosis.report.gap.refitted_v.len() as u8).collect(),
    }
}

/// A joint by its number, 0 for the whole robot.
pub fn joint_words(joint: u8) -> String {
    if joint == 0 { "whole robot".into() } else { format!("joint {joint}") }
}

/// An effect's name as it is said.
pub fn effect_words(effect: &str) -> String {
    effect.replace('_', " ")
}

/// Parameters of an effect as they are said, "8 per turn, 0.11 V": the harmonic first, then as
/// in the catalogue; the phase only where `all` are wanted.
pub fn parameter_words(
    catalogue: &Catalogue,
    effect: &str,
    parameters: &BTreeMap<String, Value>,
    all: bool,
) -> String {
    let alone = parameters.len() == 1;
    let known = catalogue.by_name(effect).map_or(&[][..], |definition| definition.parameters);
    let mut ordered: Vec<&Parameter> = known.iter().collect();
    ordered.dedup_by_key(|parameter| parameter.name);
    ordered.sort_by_key(|parameter| parameter.kind != Kind::Harmonic);
    ordered.retain(|parameter| all || parameter.kind != Kind::Phase);
    let said = ordered.into_iter().filter_map(|parameter| {
        Some(one_parameter(parameter, parameters.get(parameter.name)?, alone))
    });
    said.collect::<Vec<_>>().join(", ")
}

fn one_parameter(parameter: &Parameter, value: &Value, alone: bool) -> String {
    let (noun, unit) = split_unit(parameter.name);
    let said = match value {
        Value::Number(value) if parameter.kind == Kind::Harmonic => {
            return format!("{} per turn", number(*value));
        }
        Value::Number(value) if unit.is_empty() => format!("{:+.1} %", 100.0 * value),
        Value::Number(value) => quantity(*value, unit),
        Value::Vector(values) => {
            let values: Vec<String> = values.iter().map(|value| number(*value)).collect();
            format!("({}) {unit}", values.join(", "))
        }
    };
    let obvious = alone || parameter.kind == Kind::Amplitude || unit.is_empty();
    if obvious { said } else { format!("{} {said}", noun.replace('_', " ")) }
}

fn named(diagnosis: &Diagnosis) -> String {
    let report = &diagnosis.report;
    let words = |cause| cause_words(&diagnosis.catalogue, cause);
    let causes: Vec<String> = report.causes.iter().map(words).collect();
    let rivals: Vec<String> = report
        .alternatives
        .iter()
        .map(|other| format!("{} on {}", effect_words(&other.effect), joint_words(other.joint)))
        .collect();
    match rivals.as_slice() {
        [] => causes.join(" "),
        rivals => format!("{} Not ruled out: {}.", causes.join(" "), rivals.join(", ")),
    }
}

fn cause_words(catalogue: &Catalogue, cause: &Cause) -> String {
    let parameters = parameter_words(catalogue, &cause.effect, &cause.parameters, false);
    format!(
        "{}: {}, {parameters}, explains {:.0} % of the gap.",
        capitalised(&joint_words(cause.joint)),
        effect_words(&cause.effect),
        100.0 * cause.share
    )
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_uppercase().collect::<String>() + letters.as_str()
    })
}

fn no_gap(diagnosis: &Diagnosis) -> String {
    let gap = &diagnosis.report.gap;
    let joints = joint_numbers(diagnosis);
    let largest = largest_excess(&gap.refitted_v, &gap.noise_floor_v);
    let (Some((index, _)), true) = (largest, gap.as_given_v.len() == gap.refitted_v.len()) else {
        return "No gap above the noise.".into();
    };
    let joint = joints.get(index).copied().unwrap_or(0);
    let (given_v, left_v) = (gap.as_given_v[index], gap.refitted_v[index]);
    let floor = volts(gap.noise_floor_v[index]);
    if given_v > diagnosis.criteria.verdict.worth_refitting * left_v {
        let (given, left) = (volts(given_v), volts(left_v));
        return format!(
            "No gap above the noise once the model is refitted: that takes joint {joint} from \
             {given} to {left}, where noise alone leaves {floor}."
        );
    }
    let left = volts(left_v);
    format!("No gap above the noise: {left} are left on joint {joint}, noise alone leaves {floor}.")
}

fn unexplained(diagnosis: &Diagnosis) -> String {
    let report = &diagnosis.report;
    let left =
        if report.causes.is_empty() { &report.gap.refitted_v } else { &report.gap.with_effects_v };
    let size = largest_excess(left, &report.gap.noise_floor_v);
    let joints = joint_numbers(diagnosis);
    let mut text = match size.and_then(|(index, excess_v)| Some((joints.get(index)?, excess_v))) {
        Some((joint, excess_v)) => {
            let share = report.gap_shares.iter().find(|share| share.joint == *joint);
            format!(
                "A gap of {} on joint {joint} that nothing in the catalogue explains{}.",
                volts(excess_v),
                share.map_or_else(String::new, |share| format!("; {}", varies(share)))
            )
        }
        None => "A gap that nothing in the catalogue explains.".into(),
    };
    for cause in &report.causes {
        text += &format!(" A part has a name: {}", cause_words(&diagnosis.catalogue, cause));
    }
    text
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

/// An axis as it is said.
pub fn axis_words(axis: Axis) -> &'static str {
    match axis {
        Axis::Position => "position",
        Axis::Velocity => "velocity",
        Axis::Acceleration => "acceleration",
        Axis::Command => "command",
        Axis::Load => "load",
        Axis::Time => "time",
        Axis::Frequency => "frequency",
        Axis::Offset => "offset",
    }
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

    fn parameters(of: &[(&str, f64)]) -> BTreeMap<String, Value> {
        of.iter().map(|(name, value)| ((*name).to_owned(), Value::Number(*value))).collect()
    }

    #[test]
    fn a_cause_is_said_in_one_sentence() {
        let cause = Cause {
            effect: "cogging".into(),
            joint: 3,
            parameters: parameters(&[
                ("amplitude_V", 0.1101),
                ("harmonic", 8.0),
                ("phase_rad", 0.9),
            ]),
            ..crate::synthetic::cogging()
        };
        let said = cause_words(&Catalogue::standard(), &cause);
        assert_eq!(said, "Joint 3: cogging, 8 per turn, 0.11 V, explains 95 % of the gap.");
    }

    #[test]
    fn units_and_signs_are_said() {
        let catalogue = Catalogue::standard();
        let said = |effect: &str, of: &[(&str, f64)]| {
            parameter_words(&catalogue, effect, &parameters(of), true)
        };
        assert_eq!(said("delay", &[("delay_s", 0.0021)]), "2.1 ms");
        assert_eq!(said("torque_constant", &[("relative_error", -0.052)]), "-5.2 %");
        let elastic = [
            ("stiffness_Nm_per_rad", 3012.0),
            ("damping_Nm_s_per_rad", 1.0),
            ("motor_inertia_kg_m2", 0.02),
        ];
        let words = "stiffness 3010 Nm/rad, damping 1 Nm s/rad, motor inertia 0.02 kg m^2";
        assert_eq!(said("joint_elasticity", &elastic), words);
        let force = BTreeMap::from([("force_N".to_owned(), Value::Vector(vec![0.0, 1.5, -3.25]))]);
        assert_eq!(parameter_words(&catalogue, "tip_force", &force, true), "(0, 1.5, -3.25) N");
    }
}
