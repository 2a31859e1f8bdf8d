//! The search for the possible arm that leaves least.

use nalgebra::{DMatrix, DVector};
use signal::estimation::{NonlinearSettings, minimise};

use super::error::ArmError;
use super::own_prior::Rotor;
use super::settings::Settings;
use super::unknowns::{COULOMB, JointUnknowns, OF_JOINT, ROTOR, Unknowns};

/// What the search found.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// What was searched.
    pub unknowns: Unknowns,
    /// The unknowns' values.
    pub values: Vec<f64>,
    /// Their covariance.
    pub covariance: DMatrix<f64>,
    /// Squares that are left, those of the prior among them.
    pub squares: f64,
}

impl Fit {
    /// The numbers in which commands are linear.
    pub fn numbers(&self) -> Vec<f64> {
        self.unknowns.numbers(&self.values)
    }

    /// One of a joint's own numbers and its standard error.
    pub fn own(&self, joint: usize, which: usize) -> [f64; 2] {
        let at = OF_JOINT * joint + COULOMB + which;
        [self.values[at], self.covariance[(at, at)].sqrt()]
    }

    /// Whether a joint's unknown rotor may be none: an unknown link takes its place easily.
    fn is_rotor_in_doubt(&self, joint: usize, settings: &Settings) -> bool {
        let at = OF_JOINT * joint + ROTOR;
        let JointUnknowns { rotor, link, .. } = &self.unknowns.joints[joint];
        let is_open = self.covariance[(at, at)].sqrt() > settings.rotor_doubt;
        matches!(rotor, Rotor::Unknown(_)) && (is_open || !link.is_given())
    }

    /// Standard errors of functions of the unknowns, by their slopes.
    pub fn standard_errors(&self, of: impl Fn(&[f64]) -> Vec<f64>) -> Vec<f64> {
        let (middle, scale) = (of(&self.values), self.unknowns.scale());
        let mut slopes = DMatrix::zeros(middle.len(), self.values.len());
        for (column, scale) in scale.iter().enumerate() {
            let step = 1e-5 * scale;
            let at = |sign: f64| {
                let mut values = self.values.clone();
                values[column] += sign * step;
                DVector::from_vec(of(&values))
            };
            slopes.set_column(column, &((at(1.0) - at(-1.0)) / (2.0 * step)));
        }
        let covariance = &slopes * &self.covariance * slopes.transpose();
        covariance.diagonal().iter().map(|variance| variance.max(0.0).sqrt()).collect()
    }
}

/// Fits from a start; then without each unknown rotor that the fit can do without, and without friction that
/// would drive.
///
/// # Errors
/// The search comes to nothing.
pub fn fit(
    rows: &DMatrix<f64>,
    unknowns: Unknowns,
    start: &[f64],
    settings: &Settings,
) -> Result<Fit, ArmError> {
    let mut found = search(rows, unknowns, start)?;
    for index in 0..found.unknowns.joints.len() {
        if found.is_rotor_in_doubt(index, settings) {
            let mut without = found.unknowns.clone();
            without.joints[index].rotor = Rotor::Fixed(0.0);
            let other = search(rows, without, &found.values)?;
            if other.squares < found.squares + settings.rotor_evidence {
                found = other;
            }
        }
    }
    while let Some(without) = without_driving_friction(&found) {
        found = search(rows, without, &found.values)?;
    }
    Ok(found)
}

/// The same unknowns without friction that would drive: Coulomb's level below zero, terms that must not be, and a square
/// that takes more of the viscous slope than there is at the largest velocity; `None` where there is none.
fn without_driving_friction(found: &Fit) -> Option<Unknowns> {
    let mut unknowns = found.unknowns.clone();
    for (joint, own) in unknowns.joints.iter_mut().zip(found.values.chunks_exact(OF_JOINT)) {
        joint.without_coulomb |= own[COULOMB] < 0.0;
        joint.close_driving_terms(&own[COULOMB..]);
    }
    (unknowns != found.unknowns).then_some(unknowns)
}

fn search(rows: &DMatrix<f64>, unknowns: Unknowns, start: &[f64]) -> Result<Fit, ArmError> {
    let count = rows.ncols() - 1;
    let (columns, command) = (rows.columns(0, count), rows.column(count));
    let residuals = |all: &[f64]| -> Option<Vec<f64>> {
        let left = columns * DVector::from_vec(unknowns.numbers(all)) - command;
        let all = left.iter().copied().chain(unknowns.prior_residuals(all)).collect::<Vec<_>>();
        all.iter().all(|r| r.is_finite()).then_some(all)
    };
    let settings = NonlinearSettings { tolerance: 1e-7, patience: 20, relative_step: 1e-5 };
    let found = minimise(residuals, start, &unknowns.scale(), &settings);
    let found = found.ok_or_else(|| ArmError::Numerical("the start is out of range".to_owned()))?;
    let covariance = found.unit_covariance.ok_or_else(|| {
        ArmError::Numerical("the logs and what is given leave a parameter open".to_owned())
    })?;
    let squares = found.residuals.norm_squared();
    Ok(Fit { values: found.parameters, covariance, squares, unknowns })
}
