//! The robot file with what was found.

use files::{ArmFile, ArmJoint, EffectTable};
use model::chain::BODY_PARAMETERS;

use super::fit::Fit;
use super::friction_terms::{FrictionTerms, JointTerms, Term};
use super::layout::OWN;
use super::link_prior::{LinkValues, values_of};
use super::own_prior::Rotor;
use super::unknowns::{COULOMB, OF_JOINT, ROTOR, link_numbers};

/// The effects that the logs are asked for.
pub const SOUGHT: [&str; 2] = ["load_friction", "quadratic_drag"];

/// Whether logs are asked for an effect: friction by the load on the joint, not by what its motor gives.
pub fn is_sought(effect: &EffectTable) -> bool {
    let by_motor = effect.parameters.get("by_motor_torque").is_some_and(|choice| {
        choice.as_float().or(choice.as_integer().map(|whole| whole as f64)) != Some(0.0)
    });
    SOUGHT.contains(&effect.effect.as_str()) && !by_motor
}

/// A change below this part of the prior's doubt is none: the data said nothing.
const CHANGE: f64 = 1e-3;

/// The model: given values where the logs say nothing, else what was found, with standard errors.
pub fn model_file(arm: &ArmFile, fit: &Fit, moves: &[bool], terms: &FrictionTerms) -> ArmFile {
    let mut model = arm.clone();
    let errors = fit.standard_errors(all_values);
    let values = all_values(&fit.values);
    for (index, joint) in model.joints.iter_mut().enumerate() {
        let part = OF_JOINT * index..OF_JOINT * (index + 1);
        let (values, errors) = (&values[part.clone()], &errors[part]);
        put_link(joint, &fit.unknowns.joints[index].link.given, values, errors);
        put_rotor(joint, fit.unknowns.joints[index].rotor, values[ROTOR], errors[ROTOR]);
        if moves[index] {
            put_friction(joint, &values[COULOMB..], &errors[COULOMB..], index, fit);
        }
    }
    let is_found_anew = |effect: &EffectTable| {
        let moves = usize::from(effect.joint).checked_sub(1).and_then(|joint| moves.get(joint));
        is_sought(effect) && moves == Some(&true)
    };
    model.effects.retain(|effect| !is_found_anew(effect));
    for (joint, terms) in terms.joints.iter().enumerate() {
        put_terms(&mut model, joint, terms, fit);
    }
    model
}

/// What a joint's friction, from 0, has beyond Coulomb's level and viscous friction.
fn put_terms(model: &mut ArmFile, joint: usize, terms: &JointTerms, fit: &Fit) {
    for term in Term::ALL.into_iter().filter(|term| terms.open[*term as usize]) {
        let [value, error] = fit.own(joint, term.number());
        match term {
            Term::Peak => put_peak(&mut model.joints[joint], value, error, terms.stribeck_velocity),
            Term::Load => {
                put_effect(model, joint, SOUGHT[0], "coefficient_V_per_Nm", value);
            }
            Term::Square => {
                put_effect(model, joint, SOUGHT[1], "coefficient_V_s2_per_rad2", value);
            }
            Term::Constant => {}
        }
    }
}

fn put_peak(joint: &mut ArmJoint, height: f64, error: f64, width: f64) {
    let mut friction = joint.friction.unwrap_or_default();
    (friction.alpha1, friction.stribeck_velocity) = (Some(height), Some(width));
    joint.friction = Some(friction);
    let [_, peak, stribeck_velocity, ..] = joint.friction_names();
    joint.standard_error.insert(peak, vec![error]);
    // The best of several widths, each twice the one before: no error is known of it.
    joint.standard_error.remove(&stribeck_velocity);
}

/// An effect of a joint, from 0.
fn put_effect(model: &mut ArmFile, joint: usize, effect: &str, parameter: &str, value: f64) {
    let joint = u8::try_from(joint + 1).expect("a chain has ten joints at most");
    let parameters = toml::Table::from_iter([(parameter.to_owned(), value.into())]);
    let (effect, extra) = (effect.to_owned(), toml::Table::new());
    model.effects.push(EffectTable { effect, joint, parameters, extra });
}

/// The values of a file by the unknowns: link, rotor where it is searched, friction and constant.
fn all_values(all: &[f64]) -> Vec<f64> {
    let of_joint = |own: &[f64]| -> Vec<f64> {
        let link = values_of(&link_numbers(own));
        let rest = [own[ROTOR].exp()];
        link.into_iter().chain(rest).chain(own[COULOMB..COULOMB + OWN].iter().copied()).collect()
    };
    all.chunks_exact(OF_JOINT).flat_map(of_joint).collect()
}

fn put_link(joint: &mut ArmJoint, given: &[(usize, f64, f64)], values: &[f64], errors: &[f64]) {
    let is_as_given =
        |(k, value, doubt): &(usize, f64, f64)| (values[*k] - value).abs() <= CHANGE * doubt;
    if given.len() == BODY_PARAMETERS && given.iter().all(is_as_given) {
        return;
    }
    let found: LinkValues = core::array::from_fn(|k| values[k]);
    let [mass, x, y, z, inertia @ ..] = found;
    joint.link.mass_kg = Some(mass);
    joint.link.com_m = Some([x, y, z]);
    joint.link.inertia_kg_m2 = Some(inertia);
    let mut put = |name: &str, errors: &[f64]| {
        joint.standard_error.insert(name.to_owned(), errors.to_vec());
    };
    put("mass_kg", &errors[..1]);
    put("com_m", &errors[1..4]);
    put("inertia_kg_m2", &errors[4..BODY_PARAMETERS]);
}

fn put_rotor(joint: &mut ArmJoint, rotor: Rotor, value: f64, error: f64) {
    if let Rotor::Given(..) | Rotor::Unknown(_) = rotor {
        joint.armature = Some(value);
        joint.standard_error.insert(joint.armature_name(), vec![error]);
    }
}

fn put_friction(joint: &mut ArmJoint, values: &[f64], errors: &[f64], index: usize, fit: &Fit) {
    let mut friction = joint.friction.unwrap_or_default();
    let [coulomb, .., viscous, _, _] = joint.friction_names();
    if fit.unknowns.joints[index].without_coulomb {
        friction.alpha0 = Some(0.0);
        joint.standard_error.remove(&coulomb);
    } else {
        friction.alpha0 = Some(values[0]);
        joint.standard_error.insert(coulomb, vec![errors[0]]);
    }
    friction.alpha2 = Some(values[1]);
    joint.standard_error.insert(viscous, vec![errors[1]]);
    joint.friction = Some(friction);
}
