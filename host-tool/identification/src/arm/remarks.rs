//! What the user should know of a result.

use files::{ArmFile, ArmJoint, EffectTable};
use model::mechanism::JointKind;

use super::fit::Fit;
use super::model_file::is_sought;
use super::own_prior::Rotor;
use super::result::{Estimate, FoundTerms, IdentifiedArm};

/// Remarks on joints, from the file as given, the fit and which joints move.
pub fn remarks(arm: &ArmFile, fit: &Fit, moves: &[bool], found: &IdentifiedArm) -> Vec<String> {
    let mut all = Vec::new();
    if !found.is_held_out {
        all.push("no log has the role \"holdout\": what is left is of the logs fitted to".into());
    }
    all.extend(of_given_effects(arm));
    for (index, joint) in arm.joints.iter().enumerate() {
        let number = index + 1;
        if !moves[index] {
            all.push(format!(
                "joint {number} stands in the logs with role \"train\": its friction stays as given"
            ));
        }
        all.extend(of_link(number, joint, &found.model.joints[index]));
        let is_without = fit.unknowns.joints[index].rotor == Rotor::Fixed(0.0);
        if joint.armature.is_none() && is_without {
            all.push(format!(
                "joint {number}: the logs do not tell a rotor from the link, so none is written"
            ));
        }
        if fit.unknowns.joints[index].without_coulomb {
            all.push(format!("joint {number}: Coulomb friction came out below 0 and is held at 0"));
        }
        all.extend(of_terms(number, joint, &found.friction_terms[index]));
        all.extend(of_constant(
            number,
            joint.command_unit(),
            found.friction_terms[index].constant,
            found,
        ));
    }
    all
}

/// A link that was unknown and that the logs leave open.
fn of_link(number: usize, given: &ArmJoint, found: &ArmJoint) -> Option<String> {
    /// A mass with a larger part of doubt is no mass.
    const DOUBT: f64 = 0.3;
    let mass = found.link.mass_kg?;
    let error = found.standard_error("mass_kg")?.first()?;
    let is_open = !given.is_link_known() && *error > DOUBT * mass;
    is_open.then(|| {
        format!(
            "joint {number}: the logs do not determine its link alone; what is written is one of \
             many possible bodies with the same torques (see the standard errors)"
        )
    })
}

/// Terms of friction that the model carries as effects.
fn of_terms(number: usize, joint: &ArmJoint, terms: &FoundTerms) -> Vec<String> {
    let unit = joint.command_unit();
    let [torque, velocity] = match joint.kind {
        JointKind::Revolute => ["Nm", "(rad/s)^2"],
        JointKind::Prismatic => ["N", "(m/s)^2"],
    };
    let found = |what: &str, by: Option<Estimate>, unit_of: &str, effect: &str| {
        let Estimate { value, standard_error } = by?;
        Some(format!(
            "joint {number}: friction grows {what} by {value:.3e} {unit}/{unit_of}, give or take \
             {standard_error:.1e} (effect {effect} of the model)"
        ))
    };
    let is_less = terms.quadratic_drag.is_some_and(|drag| drag.value < 0.0);
    let how = if is_less { "less than with the velocity," } else { "with the velocity's square" };
    [
        found("with the load", terms.load_friction, torque, "load_friction"),
        found(how, terms.quadratic_drag, velocity, "quadratic_drag"),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Effects of the robot file that are not sought in the logs, nor taken off them.
fn of_given_effects(arm: &ArmFile) -> Option<String> {
    let other = |effect: &&EffectTable| !is_sought(effect);
    let names: Vec<&str> = arm.effects.iter().filter(other).map(|e| e.effect.as_str()).collect();
    (!names.is_empty()).then(|| {
        format!(
            "effects of the robot file stay in the model, but links and friction are found as if they were not there: \
             {}; identify without them, and add them again",
            names.join(", ")
        )
    })
}

/// A constant that is sure and not small.
fn of_constant(
    number: usize,
    unit: &str,
    constant: Option<Estimate>,
    found: &IdentifiedArm,
) -> Option<String> {
    /// Smaller parts of the command are of no account.
    const PART: f64 = 0.02;
    let commands = found.left.iter().filter_map(|log| log.joints[number - 1]);
    let command = commands.map(|left| left.command_rms).fold(0.0, f64::max);
    let Estimate { value, standard_error } = constant?;
    let is_sure = value.abs() > 3.0 * standard_error && value.abs() > PART * command;
    is_sure.then(|| {
        format!(
            "joint {number}: its command carries {value:.3} {unit} whatever the arm does, which the \
             model does not hold (effect dac_offset)"
        )
    })
}
