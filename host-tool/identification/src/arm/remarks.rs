//! What the user should know of a result.

use files::{ArmFile, ArmJoint};

use super::fit::Fit;
use super::own_prior::Rotor;
use super::result::{Constant, FoundTerms, IdentifiedArm};

/// Remarks on joints, from the file as given, the fit and which joints move.
pub fn remarks(arm: &ArmFile, fit: &Fit, moves: &[bool], found: &IdentifiedArm) -> Vec<String> {
    let mut all = Vec::new();
    if !found.is_held_out {
        all.push("no log has the role \"holdout\": what is left is of the logs fitted to".into());
    }
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
    let load = terms.load_friction.map(|growth| {
        let Constant { value, standard_error } = growth;
        format!(
            "joint {number}: friction grows with the load by {value:.3e} {unit}/Nm, give or take \
             {standard_error:.1e} (effect load_friction of the model)"
        )
    });
    let square = terms.quadratic_drag.map(|drag| {
        let how = if drag.value > 0.0 { "more" } else { "less" };
        format!(
            "joint {number}: friction grows {how} than with the velocity (effect quadratic_drag of \
             the model)"
        )
    });
    load.into_iter().chain(square).collect()
}

/// A constant that is sure and not small.
fn of_constant(
    number: usize,
    unit: &str,
    constant: Option<Constant>,
    found: &IdentifiedArm,
) -> Option<String> {
    /// Smaller parts of the command are of no account.
    const PART: f64 = 0.02;
    let commands = found.left.iter().filter_map(|log| log.joints[number - 1]);
    let command = commands.map(|left| left.command_rms).fold(0.0, f64::max);
    let Constant { value, standard_error } = constant?;
    let is_sure = value.abs() > 3.0 * standard_error && value.abs() > PART * command;
    is_sure.then(|| {
        format!(
            "joint {number}: its command carries {value:.3} {unit} whatever the arm does, which the \
             model does not hold (effect dac_offset)"
        )
    })
}
