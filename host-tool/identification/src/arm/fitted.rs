//! An arm fitted to its logs, commands held from row to row or sampled at the rows.

use files::ArmFile;
use model::chain::SerialChain;
use model::mechanism::Mechanism;
use nalgebra::DMatrix;

use super::choice_of_terms::shown;
use super::error::ArmError;
use super::fit::{Fit, fit};
use super::fitting::{Fitting, count};
use super::friction_terms::FrictionTerms;
use super::layout::Layout;
use super::logs::PreparedLog;
use super::motion::CommandTime;
use super::rows::{Equations, JointRows};
use super::settings::Settings;
use super::weights::left_of;

/// What is found where commands act at a given time.
pub struct Fitted {
    /// When they do.
    pub time: CommandTime,
    /// Which joints have rows enough.
    pub moves: Vec<bool>,
    /// What commands have beyond Coulomb's level and viscous friction.
    pub terms: FrictionTerms,
    /// All rows, condensed and weighted.
    pub rows: DMatrix<f64>,
    /// The numbers found.
    pub found: Fit,
    /// Logarithm of what is left of a joint's command, typically, mean over rows.
    misfit: f64,
}

/// Commands held or sampled, whichever leaves less by what is known of the arm: parameters that are free make up for
/// commands at the wrong time, the more so where friction leads velocity.
///
/// # Errors
/// No joint moves, or the logs leave a parameter open, however the commands act.
pub fn likelier(
    arm: &ArmFile,
    logs: &[PreparedLog],
    equations: Equations,
    settings: &Settings,
) -> Result<Fitted, ArmError> {
    let [held, sampled] = [CommandTime::Held, CommandTime::Sampled]
        .map(|time| Fitting::new(arm, logs, equations, time, settings));
    let (fitting, plain) = match (without_terms(&held), without_terms(&sampled)) {
        (Ok(of_held), Ok(of_sampled)) if of_sampled.misfit < of_held.misfit => {
            (sampled, of_sampled)
        }
        (Err(_), Ok(of_sampled)) => (sampled, of_sampled),
        (of_held, _) => (held, of_held?),
    };
    Ok(with_terms(&fitting, plain))
}

fn without_terms(fitting: &Fitting) -> Result<Fitted, ArmError> {
    fitted(fitting, FrictionTerms::none(fitting.equations.chain), None)
}

/// The fit with the terms that the logs show, loads by the links found without, and once more by those found with
/// them. Where terms leave a parameter open, the logs do not show them.
fn with_terms(fitting: &Fitting, plain: Fitted) -> Fitted {
    let loaded = |by: &Fitted| with_links(fitting.equations.chain, &by.found);
    let none = FrictionTerms { chain: loaded(&plain), ..plain.terms.clone() };
    let terms = shown(fitting, none, &plain.moves);
    if terms.is_none() {
        return plain;
    }
    let again = |found: &Fitted| {
        let terms = FrictionTerms { chain: loaded(found), ..found.terms.clone() };
        fitted(fitting, terms, Some(found))
    };
    match fitted(fitting, terms, Some(&plain)) {
        Ok(found) => again(&found).unwrap_or(found),
        Err(_) => plain,
    }
}

/// The fit with some terms, searched from another fit or from what is given.
fn fitted(
    fitting: &Fitting,
    terms: FrictionTerms,
    near: Option<&Fitted>,
) -> Result<Fitted, ArmError> {
    let rows = fitting.rows(&terms);
    let moves = rows.moves(fitting.settings);
    if !moves.contains(&true) {
        return Err(ArmError::NoMotion);
    }
    let mut unknowns = fitting.unknowns(&terms);
    let start = near.map_or_else(|| unknowns.start(), |near| near.found.values.clone());
    if let Some(near) = near {
        // A rotor that the fit nearby did without has no value to start from.
        unknowns.take_rotors(&near.found.unknowns);
    }
    let found = fit(&rows.rows, unknowns, &start, fitting.settings)?;
    let terms =
        terms.with_open(&found.unknowns.joints.iter().map(|joint| joint.terms).collect::<Vec<_>>());
    let misfit = mean_misfit(&rows.all, &moves, &found, fitting.layout());
    Ok(Fitted { time: fitting.time, moves, terms, rows: rows.rows, found, misfit })
}

/// The chain with the links that a fit found.
pub fn with_links(chain: &SerialChain<f64>, fit: &Fit) -> SerialChain<f64> {
    let mut found = *chain;
    found.set_parameters(&fit.numbers()[..chain.parameter_count()]);
    found
}

/// Logarithm of what is typically left of a joint's command, mean over the rows of joints that move.
fn mean_misfit(all: &[JointRows], moves: &[bool], found: &Fit, layout: Layout) -> f64 {
    let numbers = found.numbers();
    let moving = || (0..layout.joints).filter(|joint| moves[*joint]);
    let of_joint =
        |joint| count(all, joint) as f64 * typical_left(all, joint, &numbers, layout).ln();
    let rows = moving().map(|joint| count(all, joint) as f64).sum::<f64>();
    moving().map(of_joint).sum::<f64>() / rows
}

/// The median of what the numbers leave of a joint's command, in size: where it turns round, friction that leads or lags
/// velocity is early or late by itself.
fn typical_left(rows: &[JointRows], joint: usize, numbers: &[f64], layout: Layout) -> f64 {
    let left = left_of(rows, joint, numbers, layout);
    let mut sizes: Vec<f64> = left.into_iter().flatten().map(f64::abs).collect();
    sizes.sort_by(f64::total_cmp);
    sizes.get(sizes.len() / 2).copied().unwrap_or_default().max(f64::MIN_POSITIVE)
}
