//! Names and sizes in words.

use std::collections::BTreeMap;

use crate::quantity::{number, quantity, scale, split_unit};
use crate::result::{Axis, Cause, Interval, ParameterChange, Value};
use rig::effects::{Catalogue, Kind, Parameter};

/// A joint by its number, 0 for the whole robot.
pub fn joint_words(joint: u8) -> String {
    if joint == 0 { "whole robot".into() } else { format!("joint {joint}") }
}

/// The number of a joint from its words; 0 where they name none.
pub fn joint_of(words: &str) -> u8 {
    words.strip_prefix("joint ").and_then(|number| number.parse().ok()).unwrap_or(0)
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
    let said = in_order(catalogue, effect, all).into_iter().filter_map(|parameter| {
        let value = parameters.get(parameter.name)?;
        Some(one_parameter(parameter, value, None, parameters.len() == 1))
    });
    said.collect::<Vec<_>>().join(", ")
}

/// The parameters of a cause as they are said in a sentence: without the phase, and without components that the logs do
/// not tell.
pub fn told_parameters(catalogue: &Catalogue, cause: &Cause) -> String {
    let said = in_order(catalogue, &cause.effect, false).into_iter().filter_map(|parameter| {
        let value = cause.parameters.get(parameter.name)?;
        let interval = cause.parameter_intervals.get(parameter.name);
        Some(one_parameter(parameter, value, interval, cause.parameters.len() == 1))
    });
    said.collect::<Vec<_>>().join(", ")
}

/// The parameters of a cause, with their intervals where these say more than the digits do.
pub fn parameters_with_intervals(catalogue: &Catalogue, cause: &Cause) -> String {
    let said = in_order(catalogue, &cause.effect, true).into_iter().filter_map(|parameter| {
        let value = cause.parameters.get(parameter.name)?;
        let interval = cause.parameter_intervals.get(parameter.name);
        let words = one_parameter(parameter, value, interval, cause.parameters.len() == 1);
        let interval = interval.and_then(|interval| interval_words(parameter, value, interval));
        Some(words + &interval.unwrap_or_default())
    });
    said.collect::<Vec<_>>().join(", ")
}

/// An effect's parameters, each name once, the harmonic first; the phase only where `all` are
/// wanted.
fn in_order<'a>(catalogue: &'a Catalogue, effect: &str, all: bool) -> Vec<&'a Parameter> {
    let known = catalogue.by_name(effect).map_or(&[][..], |definition| definition.parameters);
    let mut ordered: Vec<&Parameter> = known.iter().collect();
    ordered.dedup_by_key(|parameter| parameter.name);
    ordered.sort_by_key(|parameter| parameter.kind != Kind::Harmonic);
    ordered.retain(|parameter| all || parameter.kind != Kind::Phase);
    ordered
}

fn one_parameter(
    parameter: &Parameter,
    value: &Value,
    interval: Option<&Interval>,
    alone: bool,
) -> String {
    let (noun, unit) = split_unit(parameter.name);
    let is_told = |k: usize| is_told(parameter, interval, k);
    let said = match value {
        Value::Vector(values) if !(0..values.len()).any(is_told) => NOT_TOLD.into(),
        Value::Number(value) if parameter.kind == Kind::Harmonic => {
            return format!("{} per turn", number(*value));
        }
        Value::Number(_) if parameter.kind == Kind::Choice => {
            return parameter.name.replace('_', " ");
        }
        Value::Number(value) if unit.is_empty() => format!("{:+.1} %", 100.0 * value),
        Value::Number(value) => quantity(*value, unit),
        Value::Vector(values) => {
            let component = |(k, value): (usize, &f64)| {
                if is_told(k) { number(*value) } else { NOT_TOLD.into() }
            };
            let values: Vec<String> = values.iter().enumerate().map(component).collect();
            format!("({}) {unit}", values.join(", "))
        }
    };
    let obvious = alone || parameter.kind == Kind::Amplitude || unit.is_empty();
    if obvious { said } else { format!("{} {said}", noun.replace('_', " ")) }
}

/// In place of what logs do not tell.
const NOT_TOLD: &str = "not told";

/// Whether the interval of a vector's component is narrower than half of all that there is: the height of a load, say, on
/// an arm whose axes are upright, is not told.
fn is_told(parameter: &Parameter, interval: Option<&Interval>, component: usize) -> bool {
    let Some(Interval::Vector(ends)) = interval else { return true };
    let most = 0.5 * (parameter.highest - parameter.lowest);
    ends.get(component).is_none_or(|[low, high]| high - low < most)
}

/// " [0.106 to 0.114]" in the unit of the value; none where it is within the digits that are said.
fn interval_words(parameter: &Parameter, value: &Value, interval: &Interval) -> Option<String> {
    const WITHIN_DIGITS: f64 = 0.005;
    let unit = split_unit(parameter.name).1;
    match (value, interval) {
        (Value::Number(value), Interval::Number([low, high])) => {
            let scale = if unit.is_empty() { 100.0 } else { scale(*value, unit) };
            let is_wide = high - low > 2.0 * WITHIN_DIGITS * value.abs();
            let ends = [low, high].map(|end| number(scale * end));
            let said = !parameter.kind.is_tried() && is_wide;
            said.then(|| format!(" [{} to {}]", ends[0], ends[1]))
        }
        (Value::Vector(_), Interval::Vector(ends)) => {
            let halves: Vec<String> =
                ends.iter().map(|[low, high]| number(0.5 * (high - low))).collect();
            Some(format!(" ± ({})", halves.join(", ")))
        }
        _ => None,
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

/// How sure a probability makes one, "sure (98 %)".
pub fn certainty_words(probability: f64) -> String {
    const SURE: f64 = 0.9;
    const LIKELY: f64 = 0.7;
    let word = match probability {
        p if p >= SURE => "sure",
        p if p >= LIKELY => "likely",
        _ => "possible",
    };
    format!("{word} ({} %)", percent(probability))
}

/// A part in hundredths, with one decimal where it is below one of them.
pub fn percent(part: f64) -> String {
    let value = 100.0 * part;
    if value != 0.0 && value.abs() < 0.95 { format!("{value:.1}") } else { format!("{value:.0}") }
}

/// A parameter of the model as it is said: its place, and its name there.
pub fn model_parameter_words(parameter: &str) -> (String, String) {
    let (owner, name) = parameter.split_once('.').unwrap_or(("model", parameter));
    let index = owner.split_once('[').and_then(|(_, rest)| rest.strip_suffix(']'));
    let noun = split_unit(name).0;
    match (owner, index) {
        ("base", _) => base_words(name),
        (_, Some(joint)) => (format!("joint {joint}"), friction_words(noun).into()),
        (owner, None) => (owner.into(), noun.replace('_', " ")),
    }
}

fn friction_words(noun: &str) -> &str {
    match noun {
        "alpha0" => "Coulomb friction",
        "alpha1" => "rise of friction towards standstill",
        "stribeck_velocity" => "Stribeck velocity",
        "alpha2" => "viscous friction",
        "sigma0" => "bristle stiffness",
        "sigma1" => "bristle damping",
        "mass" => "mass",
        "mx" | "my" | "mz" => "first moment",
        "armature" => "rotor inertia",
        noun if noun.starts_with('i') && noun.len() == 3 => "inertia",
        other => other,
    }
}

/// The base parameters of eq. (4) by the link whose number they bear.
fn base_words(name: &str) -> (String, String) {
    let link = name.chars().find(char::is_ascii_digit).unwrap_or('0');
    let noun = match name.get(..2).unwrap_or(name) {
        "mx" | "my" => "first moment",
        "ia" => "rotor inertia",
        _ => "inertia",
    };
    (format!("link {link}"), format!("{noun} {name}"))
}

/// By how much a parameter changed: in parts of what was given, or from and to where that is 0 or
/// of the other sign.
pub fn change_words(change: &ParameterChange) -> String {
    let (given, found) = (change.given, change.found);
    let unit = split_unit(&change.parameter).1;
    if !change.is_given {
        return format!("{}, which the model does not tell", quantity(found, unit));
    }
    if given * found > 0.0 {
        return format!("{:+.0} %", 100.0 * (found / given - 1.0));
    }
    format!("from {} to {}", quantity(given, unit), quantity(found, unit))
}

/// The same text with a capital letter.
pub fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_uppercase().collect::<String>() + letters.as_str()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parameters(of: &[(&str, f64)]) -> BTreeMap<String, Value> {
        of.iter().map(|(name, value)| ((*name).to_owned(), Value::Number(*value))).collect()
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

    #[test]
    fn intervals_are_said_where_they_are_wider_than_the_digits() {
        let catalogue = Catalogue::standard();
        let said = parameters_with_intervals(&catalogue, &crate::synthetic::cogging());
        assert_eq!(said, "8 per turn, 0.11 V [0.106 to 0.114], phase 0.9 rad [0.86 to 0.94]");
        let said = parameters_with_intervals(&catalogue, &crate::synthetic::payload());
        assert_eq!(said, "0.42 kg [0.415 to 0.425]");
        let force = Value::Vector(vec![1.0, 0.0, 0.0]);
        let interval = Interval::Vector(vec![[0.9, 1.1], [-0.2, 0.2], [0.0, 0.0]]);
        let tip_force = catalogue.by_name("tip_force").unwrap();
        let said = interval_words(&tip_force.parameters[0], &force, &interval);
        assert_eq!(said.unwrap(), " ± (0.1, 0.2, 0)");
    }

    /// A load on an arm whose axes are all upright.
    #[test]
    fn a_component_that_the_logs_do_not_tell_is_not_said() {
        let place = &Catalogue::of_arm(4).by_name("payload").unwrap().parameters[1];
        let value = Value::Vector(vec![0.1, 0.0, 0.3]);
        let interval = |z: [f64; 2]| Interval::Vector(vec![[0.09, 0.11], [-0.01, 0.01], z]);
        let said = |z: [f64; 2]| one_parameter(place, &value, Some(&interval(z)), false);
        assert_eq!(said([place.lowest, place.highest]), "com (0.1, 0, not told) m");
        assert_eq!(said([-0.9, 0.9]), "com (0.1, 0, 0.3) m");
        assert_eq!(said([-1.0, 1.6]), "com (0.1, 0, not told) m");
        let nowhere = Interval::Vector(vec![[place.lowest, place.highest]; 3]);
        assert_eq!(one_parameter(place, &value, Some(&nowhere), false), "com not told");
    }

    #[test]
    fn parameters_of_the_model_have_words() {
        let said = |name: &str| {
            let (place, words) = model_parameter_words(name);
            format!("{place}: {words}")
        };
        assert_eq!(said("friction[2].alpha2_V_s_per_rad"), "joint 2: viscous friction");
        assert_eq!(said("friction[3].stribeck_velocity_rad_per_s"), "joint 3: Stribeck velocity");
        assert_eq!(said("base.zz1r"), "link 1: inertia zz1r");
        assert_eq!(said("pendulum.gravity_torque_Nm"), "pendulum: gravity torque");
    }

    #[test]
    fn changes_are_parts_of_what_was_given() {
        let change =
            |given, found| ParameterChange { given, found, ..crate::synthetic::more_viscous() };
        assert_eq!(change_words(&change(0.07, 0.0826)), "+18 %");
        assert_eq!(change_words(&change(-0.2, -0.1)), "-50 %");
        assert!(change_words(&change(0.0, 0.5)).starts_with("from 0 V s/rad to 0.5"));
        let untold = ParameterChange { is_given: false, ..change(0.07, 0.0826) };
        assert_eq!(change_words(&untold), "0.0826 V s/rad, which the model does not tell");
    }
}
