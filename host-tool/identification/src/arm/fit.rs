//! The search for the possible arm that leaves least.

use nalgebra::{DMatrix, DVector};
use signal::estimation::{NonlinearSettings, minimise};

use super::error::ArmError;
use super::own_prior::Rotor;
use super::settings::Settings;
use super::unknowns::{COULOMB, OF_JOINT, ROTOR, Unknowns};

/// What the search found.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// What was searched.
    pub unknowns: Unknowns,
    /// The unknowns' values.
    pub values: Vec<f64>,
    /// Their covariance.
    pub covariance: DMatrix<f64>,
}

impl Fit {
    /// The numbers in which commands are linear.
    pub fn numbers(&self) -> Vec<f64> {
        self.unknowns.numbers(&self.values)
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

/// Fits, and again without rotors that the data do not determine and without Coulomb friction that
/// would drive.
///
/// # Errors
/// The search comes to nothing.
pub fn fit(
    rows: &DMatrix<f64>,
    mut unknowns: Unknowns,
    settings: &Settings,
) -> Result<Fit, ArmError> {
    let mut start = unknowns.start();
    loop {
        let found = search(rows, unknowns, &start)?;
        unknowns = found.unknowns.clone();
        let mut again = false;
        for (index, joint) in unknowns.joints.iter_mut().enumerate() {
            let first = OF_JOINT * index;
            let doubt = found.covariance[(first + ROTOR, first + ROTOR)].sqrt();
            if matches!(joint.rotor, Rotor::Unknown(_)) && doubt > settings.rotor_doubt {
                joint.rotor = Rotor::Fixed(0.0);
                again = true;
            }
            if found.values[first + COULOMB] < 0.0 && !joint.without_coulomb {
                joint.without_coulomb = true;
                again = true;
            }
        }
        if !again {
            return Ok(found);
        }
        start = found.values;
    }
}

fn search(rows: &DMatrix<f64>, unknowns: Unknowns, start: &[f64]) -> Result<Fit, ArmError> {
    let count = rows.ncols() - 1;
    let (columns, command) = (rows.columns(0, count), rows.column(count));
    let residuals = |all: &[f64]| -> Option<Vec<f64>> {
        let left = columns * DVector::from_vec(unknowns.numbers(all)) - command;
        let all = left.iter().copied().chain(unknowns.prior_residuals(all)).collect::<Vec<_>>();
        all.iter().all(|r| r.is_finite()).then_some(all)
    };
    let settings = NonlinearSettings { tolerance: 1e-9, patience: 20, relative_step: 1e-5 };
    let found = minimise(residuals, start, &unknowns.scale(), &settings);
    let found = found.ok_or_else(|| ArmError::Numerical("the start is out of range".to_owned()))?;
    let covariance = found.unit_covariance.ok_or_else(|| {
        ArmError::Numerical("the logs and what is given leave a parameter open".to_owned())
    })?;
    Ok(Fit { values: found.parameters, covariance, unknowns })
}
