//! The combinations of link parameters that the commands depend on, and how well they are known.

use mechanism::BaseParameters;
use model::chain::SerialChain;
use model::mechanism::Mechanism;
use nalgebra::DMatrix;
use serde::Serialize;

use super::fit::Fit;
use super::friction_terms::Term;
use super::layout::{FRICTION, Layout};

/// A combination of link parameters.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BaseParameter {
    /// The sum, as `joint[2].mx_kg_m + 0.2 joint[3].mass_kg`.
    pub name: String,
    /// Its value.
    pub value: f64,
    /// Its standard error.
    pub standard_error: f64,
}

/// The base parameters of a chain with the fitted links, and its basis.
pub fn base_parameters(
    chain: &SerialChain<f64>,
    fit: &Fit,
) -> (BaseParameters, Vec<BaseParameter>) {
    let links = chain.parameter_count();
    let base = BaseParameters::of(chain, &mechanism::Settings::default());
    let values = |all: &[f64]| base.values(&fit.unknowns.numbers(all)[..links]);
    let errors = fit.standard_errors(values);
    let found = base.combinations.iter().zip(values(&fit.values)).zip(errors);
    let found = found.map(|((combination, value), standard_error)| BaseParameter {
        name: combination.to_string(),
        value,
        standard_error,
    });
    let found = found.collect();
    (base, found)
}

/// Largest over smallest singular value of the weighted rows of base parameters and friction,
/// columns scaled to one; `None` where the logs alone leave one of them open.
pub fn condition_number(
    rows: &DMatrix<f64>,
    base: &BaseParameters,
    fit: &Fit,
    moves: &[bool],
) -> Option<f64> {
    let joints = &fit.unknowns.joints;
    let layout = Layout { joints: joints.len() };
    let of_joint = |joint: usize| {
        let terms = Term::ALL.into_iter().filter(move |term| joints[joint].terms[*term as usize]);
        (0..FRICTION).chain(terms.map(Term::number)).map(move |which| layout.own(joint) + which)
    };
    let own = (0..layout.joints).filter(|joint| moves[*joint]).flat_map(of_joint);
    let columns: Vec<usize> = base.columns().into_iter().chain(own).collect();
    let mut chosen = rows.select_columns(&columns);
    for mut column in chosen.column_iter_mut() {
        let length = column.norm();
        if length <= 0.0 {
            return None;
        }
        column /= length;
    }
    let singular = chosen.svd(false, false).singular_values;
    let ratio = singular.max() / singular.min();
    (rows.nrows() >= columns.len() && ratio < 1e12).then_some(ratio)
}
