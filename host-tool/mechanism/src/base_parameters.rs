//! Base parameters by a rank-revealing QR decomposition (Gautier, *Numerical calculation of the
//! base inertial parameters of robots*, Journal of Robotic Systems 8, 1991).

use model::chain::LINK_PARAMETERS;
use model::mechanism::{Mechanism, ParameterName};
use nalgebra::{DMatrix, DVector};

use super::combination::Combination;
use super::observation::{Observation, Settings};

/// The combinations of parameters that the torques of a mechanism depend on.
#[derive(Clone, Debug, PartialEq)]
pub struct BaseParameters {
    /// As many as the regressor has rank, in the order of their columns.
    pub combinations: Vec<Combination>,
    /// Parameters without any effect on the torques.
    pub without_effect: Vec<ParameterName>,
}

impl BaseParameters {
    /// Those of a mechanism.
    pub fn of(mechanism: &dyn Mechanism<f64>, settings: &Settings) -> Self {
        let observation = Observation::of(mechanism, settings);
        let mut kept = independent(&observation.matrix, settings.tolerance);
        kept.sort_unstable();
        let factors = factors(&observation, &kept, settings.tolerance);
        let name = |index: usize| mechanism.parameter_name(index);
        let combination = |(row, column): (usize, &usize)| {
            let others = (0..factors.ncols()).filter(|index| !kept.contains(index));
            let others = others.map(|index| (index, name(index), factors[(row, index)]));
            let others = others.filter(|(.., factor)| *factor != 0.0);
            Combination {
                terms: [(*column, name(*column), 1.0)].into_iter().chain(others).collect(),
            }
        };
        Self {
            combinations: kept.iter().enumerate().map(combination).collect(),
            without_effect: without_effect(&observation, &factors).map(name).collect(),
        }
    }

    /// The combinations' values, from the values of all parameters.
    pub fn values(&self, parameters: &[f64]) -> Vec<f64> {
        self.combinations.iter().map(|combination| combination.value(parameters)).collect()
    }

    /// The regressor's columns that remain.
    pub fn columns(&self) -> Vec<usize> {
        self.combinations.iter().map(Combination::column).collect()
    }
}

/// Columns that no others before them make up: Gram and Schmidt's orthogonalisation, twice over so
/// that rounding stays small, in the order of preference.
fn independent(matrix: &DMatrix<f64>, tolerance: f64) -> Vec<usize> {
    let mut basis: Vec<DVector<f64>> = Vec::new();
    let mut kept = Vec::new();
    for index in order_of_preference(matrix.ncols()) {
        let mut rest = matrix.column(index).into_owned();
        for direction in basis.iter().chain(&basis) {
            let share = direction.dot(&rest);
            rest.axpy(-share, direction, 1.0);
        }
        let length = rest.norm();
        if length > tolerance {
            basis.push(rest / length);
            kept.push(index);
        }
    }
    kept
}

/// The usual choice for links that turn about z (Khalil and Dombre): masses, the moment along the
/// axis, one of two moments of inertia and rotors go into the others where they can.
fn order_of_preference(columns: usize) -> Vec<usize> {
    // izz ixx ixy ixz iyz mx my, then iyy mz mass, then the rotor.
    const ORDER: [usize; LINK_PARAMETERS] = [9, 4, 5, 6, 8, 1, 2, 7, 3, 0, 10];
    if !columns.is_multiple_of(LINK_PARAMETERS) {
        return (0..columns).collect();
    }
    let links = columns / LINK_PARAMETERS;
    ORDER.iter().flat_map(|k| (0..links).map(move |link| LINK_PARAMETERS * link + k)).collect()
}

/// What each column is in terms of those kept: kept x p.
///
/// Compared with the tolerance while columns have length one, then in the parameters' own units.
fn factors(observation: &Observation, kept: &[usize], tolerance: f64) -> DMatrix<f64> {
    let chosen = observation.matrix.select_columns(kept);
    let qr = chosen.qr();
    let mut factors = qr.q().transpose() * &observation.matrix;
    // Independent columns make R regular.
    qr.r().solve_upper_triangular_mut(&mut factors);
    for ((row, column), factor) in (0..factors.ncols())
        .flat_map(|c| (0..kept.len()).map(move |r| (r, c)))
        .zip(factors.iter_mut())
    {
        let is_nothing = factor.abs() < tolerance;
        let scale = observation.lengths[column] / observation.lengths[kept[row]];
        *factor = if is_nothing { 0.0 } else { *factor * scale };
    }
    factors
}

fn without_effect<'a>(
    observation: &'a Observation,
    factors: &'a DMatrix<f64>,
) -> impl Iterator<Item = usize> + 'a {
    (0..factors.ncols())
        .filter(|&index| observation.lengths[index] == 0.0 || factors.column(index).norm() == 0.0)
}
