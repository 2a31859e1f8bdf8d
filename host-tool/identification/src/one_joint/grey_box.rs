//! The command explained from the measured motion: LuGre friction and linear terms.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use model::Friction;
use nalgebra::{DMatrix, DVector, Dyn, Owned};

use super::bristles::Bristles;
use super::parameters::{ALPHA2, JITTER, LINEAR, from_logarithms};
use super::sandwich;
use super::weak_priors::{DEVIATION_V, PRIORS, Prior};

/// Below this a jitter does nothing [rad/s].
const LEAST_JITTER: f64 = 1e-6;
/// The data of the fit: command = LuGre friction of the velocity + columns * factors.
#[derive(Clone, Debug)]
pub struct Data {
    /// Time between points [s].
    pub step_s: f64,
    /// Velocities at all points [rad/s].
    pub qd_rad_per_s: Vec<f64>,
    /// Mean velocities of the rows [rad/s].
    pub row_velocity_rad_per_s: Vec<f64>,
    /// How many points make a row.
    pub points_per_row: usize,
    /// Mean command of the rows [V].
    pub command_v: DVector<f64>,
    /// Means of the linear terms' regressors, a row each.
    pub columns: DMatrix<f64>,
    /// Weights of the rows; 0 leaves a row out.
    pub weight: Vec<f64>,
    /// Rows of a block for the standard errors.
    pub rows_per_block: usize,
}

impl Data {
    /// The friction's mean over every row [V].
    pub fn friction_v(&self, friction: &Friction<f64>, jitter_rad_per_s: f64) -> Vec<f64> {
        let mut bristles = Bristles::new(friction, jitter_rad_per_s, self.step_s);
        let scale = 1.0 / self.points_per_row as f64;
        let rows = self.qd_rad_per_s.chunks_exact(self.points_per_row);
        rows.map(|row| scale * row.iter().map(|&v| bristles.step(v)).sum::<f64>()).collect()
    }

    fn friction_at(&self, parameters: &DVector<f64>) -> Vec<f64> {
        self.friction_v(
            &from_logarithms(parameters.as_slice()),
            parameters[JITTER].exp().max(LEAST_JITTER),
        )
    }

    fn rows(&self) -> usize {
        self.command_v.len()
    }
}

/// A fit in progress: parameters are friction's logarithms, the jitter's, then the linear factors.
struct Problem<'a> {
    data: &'a Data,
    /// Which parameters may move.
    free: &'a [usize],
    parameters: DVector<f64>,
    friction_v: Vec<f64>,
}

impl<'a> Problem<'a> {
    fn new(data: &'a Data, free: &'a [usize], parameters: DVector<f64>) -> Self {
        let friction_v = data.friction_at(&parameters);
        Self { data, free, parameters, friction_v }
    }

    fn residual(&self) -> DVector<f64> {
        let linear = &self.data.columns * self.parameters.rows_range(LINEAR..);
        DVector::from_fn(self.data.rows(), |row, _| {
            let error = self.data.command_v[row] - self.friction_v[row] - linear[row];
            self.data.weight[row] * error
        })
    }

    /// The rows' residuals, then the priors'.
    fn residual_with_priors(&self) -> DVector<f64> {
        with_priors(&self.residual(), |prior| prior.residual_v(self.parameters.as_slice()))
    }

    /// Derivative of the residual by a parameter.
    fn derivative(&self, parameter: usize) -> DVector<f64> {
        const NUDGE: f64 = 1e-5;
        let weight = &self.data.weight;
        if parameter >= LINEAR {
            let column = self.data.columns.column(parameter - LINEAR);
            return DVector::from_fn(column.len(), |row, _| -weight[row] * column[row]);
        }
        if parameter == ALPHA2 {
            let alpha2 = self.parameters[ALPHA2].exp();
            let velocity = &self.data.row_velocity_rad_per_s;
            return DVector::from_fn(velocity.len(), |row, _| {
                -weight[row] * alpha2 * velocity[row]
            });
        }
        let mut nudged = self.parameters.clone();
        nudged[parameter] += NUDGE;
        let friction_v = self.data.friction_at(&nudged);
        DVector::from_fn(friction_v.len(), |row, _| {
            weight[row] * (self.friction_v[row] - friction_v[row]) / NUDGE
        })
    }
}

/// A vector over the rows with an entry per prior behind.
fn with_priors(rows: &DVector<f64>, of_prior: impl Fn(&Prior) -> f64) -> DVector<f64> {
    let all = rows.iter().copied().chain(PRIORS.iter().map(of_prior));
    DVector::from_iterator(rows.len() + PRIORS.len(), all)
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Problem<'_> {
    type ParameterStorage = Owned<f64, Dyn>;
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;

    fn set_params(&mut self, x: &DVector<f64>) {
        for (&parameter, &value) in self.free.iter().zip(x.iter()) {
            self.parameters[parameter] = value;
        }
        self.friction_v = self.data.friction_at(&self.parameters);
    }

    fn params(&self) -> DVector<f64> {
        DVector::from_iterator(self.free.len(), self.free.iter().map(|&p| self.parameters[p]))
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        Some(self.residual_with_priors())
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let columns: Vec<DVector<f64>> = self
            .free
            .iter()
            .map(|&p| with_priors(&self.derivative(p), |prior| prior.derivative(p)))
            .collect();
        Some(DMatrix::from_columns(&columns))
    }
}

/// The result of a fit.
#[derive(Clone, Debug)]
pub struct Fit {
    /// Friction's logarithms, the jitter's, then the linear factors.
    pub parameters: DVector<f64>,
    /// Covariance of the parameters that were free; zero for the others.
    pub covariance: DMatrix<f64>,
    /// Residual of every row, not weighted, zero where it does not count [V].
    pub residual_v: DVector<f64>,
    /// RMS residual of the rows that count, all counted alike [V].
    pub rms_v: f64,
    /// RMS residual as weighted [V].
    pub weighted_rms_v: f64,
    /// Whether the search ended at a minimum.
    pub converged: bool,
}

impl Fit {
    /// The friction found.
    pub fn friction(&self) -> Friction<f64> {
        from_logarithms(self.parameters.as_slice())
    }

    /// Standard error of a parameter.
    pub fn standard_error(&self, parameter: usize) -> f64 {
        self.covariance[(parameter, parameter)].max(0.0).sqrt()
    }
}

/// Fits from a start, moving only the parameters that are `free`, until a step lowers
/// the sum of squares by less than the share `tolerance`.
///
/// Covariances come from leaving out blocks of rows in turn, so that slowly changing
/// residuals count as few, not as many.
pub fn fit(data: &Data, start: DVector<f64>, free: &[usize], tolerance: f64) -> Fit {
    const PATIENCE: usize = 20;
    let problem = Problem::new(data, free, start);
    let search =
        LevenbergMarquardt::new().with_ftol(tolerance).with_xtol(1e-6).with_patience(PATIENCE);
    let (problem, report) = search.minimize(problem);
    let residual_v = problem.residual();
    let counting = data.weight.iter().filter(|&&w| w > 0.0).count().max(1) as f64;
    let alike = unweighted(&residual_v, &data.weight);
    let jacobian = problem
        .jacobian()
        .unwrap_or_else(|| DMatrix::zeros(data.rows() + PRIORS.len(), free.len()));
    let of_free = sandwich::covariance(&jacobian, &residual_v, data.rows_per_block, DEVIATION_V);
    Fit {
        covariance: of_all(&of_free, free, problem.parameters.len()),
        rms_v: (alike.iter().map(|r| r * r).sum::<f64>() / counting).sqrt(),
        weighted_rms_v: (residual_v.norm_squared() / counting).sqrt(),
        residual_v: DVector::from_vec(alike),
        converged: report.termination.was_successful(),
        parameters: problem.parameters,
    }
}

/// The covariance of all parameters: zero for those that were not free.
fn of_all(of_free: &DMatrix<f64>, free: &[usize], size: usize) -> DMatrix<f64> {
    let mut covariance = DMatrix::zeros(size, size);
    for (i, &row) in free.iter().enumerate() {
        for (j, &column) in free.iter().enumerate() {
            covariance[(row, column)] = of_free[(i, j)];
        }
    }
    covariance
}

fn unweighted(residual: &DVector<f64>, weight: &[f64]) -> Vec<f64> {
    let pairs = residual.iter().zip(weight);
    pairs.map(|(r, &w)| if w > 0.0 { r / w } else { 0.0 }).collect()
}

/// Weights for another fit: rows count less where residuals nearby are large.
///
/// Reversals at speed leave ten times the residual of slow sliding; with equal weights
/// breakaway level and v_s would not be determined.
pub fn weights_from(fit: &Fit, weight: &[f64]) -> Vec<f64> {
    const REACH: usize = 12;
    const QUIET_SHARE: f64 = 0.3;
    let squares: Vec<f64> = fit.residual_v.iter().map(|r| r * r).collect();
    let local = |row: usize| {
        let near = &squares[row.saturating_sub(REACH)..(row + REACH).min(squares.len())];
        near.iter().sum::<f64>() / near.len() as f64
    };
    let variance: Vec<f64> = (0..squares.len()).map(local).collect();
    let mut sorted = variance.clone();
    sorted.sort_by(f64::total_cmp);
    let quiet = sorted[(QUIET_SHARE * sorted.len() as f64) as usize].max(1e-12);
    let pairs = variance.iter().zip(weight);
    pairs.map(|(v, &w)| if w > 0.0 { (quiet / (quiet + v)).sqrt() } else { 0.0 }).collect()
}

/// RMS residual at given parameters [V].
pub fn rms(data: &Data, parameters: &DVector<f64>) -> f64 {
    const NONE: [usize; 0] = [];
    let problem = Problem::new(data, &NONE, parameters.clone());
    let counting = data.weight.iter().sum::<f64>().max(1.0);
    (problem.residual().norm_squared() / counting).sqrt()
}
