//! The command explained from the measured motion: LuGre friction and linear terms.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use model::{Friction, FrictionState};
use nalgebra::{DMatrix, DVector, Dyn, Owned};

use super::sandwich;

/// How many parameters of the fit are those of friction.
pub const FRICTION: usize = 6;

/// The friction's parameters as the fit sees them: their logarithms, so that none
/// leaves its valid range. In the place of alpha_1, which may be negative, stands the
/// breakaway level alpha_0 + alpha_1, which may not.
pub fn to_logarithms(friction: &Friction<f64>) -> [f64; FRICTION] {
    [
        friction.alpha0_v.ln(),
        (friction.alpha0_v + friction.alpha1_v).ln(),
        friction.stribeck_velocity_rad_per_s.ln(),
        friction.alpha2_v_s_per_rad.max(1e-9).ln(),
        friction.sigma0_v_per_rad.ln(),
        friction.sigma1_v_s_per_rad.max(1e-9).ln(),
    ]
}

/// The friction of [`to_logarithms`].
pub fn from_logarithms(logarithms: &[f64]) -> Friction<f64> {
    let value = |k: usize| logarithms[k].exp();
    Friction {
        alpha0_v: value(0),
        alpha1_v: value(1) - value(0),
        stribeck_velocity_rad_per_s: value(2),
        alpha2_v_s_per_rad: value(3),
        sigma0_v_per_rad: value(4),
        sigma1_v_s_per_rad: value(5),
    }
}

/// What the fit works on: command = LuGre friction of the velocity + columns * factors.
#[derive(Clone, Debug)]
pub struct Data {
    /// Time between points [s].
    pub step_s: f64,
    /// Velocities at all points [rad/s].
    pub qd_rad_per_s: Vec<f64>,
    /// How many points make a row.
    pub points_per_row: usize,
    /// Mean command of the rows [V].
    pub command_v: DVector<f64>,
    /// Means of the linear terms' regressors, a row each.
    pub columns: DMatrix<f64>,
    /// 1 for rows that count, 0 for those that do not.
    pub weight: Vec<f64>,
    /// Rows of a block for the standard errors.
    pub rows_per_block: usize,
}

impl Data {
    /// The friction's mean over every row [V].
    ///
    /// Far from standstill z reaches its steady value within a point; there (10) does.
    pub fn friction_v(&self, friction: &Friction<f64>) -> Vec<f64> {
        const SETTLED: f64 = 40.0;
        let mut state = FrictionState::default();
        let settled_rad = SETTLED * friction.alpha0_v.max(friction.alpha0_v + friction.alpha1_v)
            / friction.sigma0_v_per_rad;
        let mut at = |velocity: f64| {
            if velocity.abs() * self.step_s < settled_rad {
                return state.step(friction, velocity, self.step_s);
            }
            let level = friction.stribeck_level(velocity);
            state.deflection_rad = level / friction.sigma0_v_per_rad * velocity.signum();
            friction.sliding(velocity)
        };
        let rows = self.qd_rad_per_s.chunks_exact(self.points_per_row);
        let scale = 1.0 / self.points_per_row as f64;
        rows.map(|row| scale * row.iter().map(|&v| at(v)).sum::<f64>()).collect()
    }

    fn rows(&self) -> usize {
        self.command_v.len()
    }
}

/// A fit in progress: parameters are friction's logarithms, then the linear factors.
struct Problem<'a> {
    data: &'a Data,
    /// Which parameters may move.
    free: &'a [usize],
    parameters: DVector<f64>,
    friction_v: Vec<f64>,
}

impl<'a> Problem<'a> {
    fn new(data: &'a Data, free: &'a [usize], parameters: DVector<f64>) -> Self {
        let friction_v = data.friction_v(&from_logarithms(parameters.as_slice()));
        Self { data, free, parameters, friction_v }
    }

    fn residual(&self) -> DVector<f64> {
        let linear = &self.data.columns * self.parameters.rows_range(FRICTION..);
        DVector::from_fn(self.data.rows(), |row, _| {
            let error = self.data.command_v[row] - self.friction_v[row] - linear[row];
            self.data.weight[row] * error
        })
    }

    fn slope(&self, parameter: usize) -> DVector<f64> {
        const NUDGE: f64 = 1e-5;
        let weight = &self.data.weight;
        if parameter >= FRICTION {
            let column = self.data.columns.column(parameter - FRICTION);
            return DVector::from_fn(column.len(), |row, _| -weight[row] * column[row]);
        }
        let mut nudged = self.parameters.clone();
        nudged[parameter] += NUDGE;
        let friction_v = self.data.friction_v(&from_logarithms(nudged.as_slice()));
        DVector::from_fn(friction_v.len(), |row, _| {
            weight[row] * (self.friction_v[row] - friction_v[row]) / NUDGE
        })
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Problem<'_> {
    type ParameterStorage = Owned<f64, Dyn>;
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;

    fn set_params(&mut self, x: &DVector<f64>) {
        for (&parameter, &value) in self.free.iter().zip(x.iter()) {
            self.parameters[parameter] = value;
        }
        self.friction_v = self.data.friction_v(&from_logarithms(self.parameters.as_slice()));
    }

    fn params(&self) -> DVector<f64> {
        DVector::from_iterator(self.free.len(), self.free.iter().map(|&p| self.parameters[p]))
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        Some(self.residual())
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let slopes: Vec<DVector<f64>> = self.free.iter().map(|&p| self.slope(p)).collect();
        Some(DMatrix::from_columns(&slopes))
    }
}

/// What a fit found.
#[derive(Clone, Debug)]
pub struct Fit {
    /// Friction's logarithms, then the linear factors.
    pub parameters: DVector<f64>,
    /// Covariance of the parameters that were free; zero for the others.
    pub covariance: DMatrix<f64>,
    /// Residual of every row [V], zero where it does not count.
    pub residual_v: DVector<f64>,
    /// RMS residual of the rows that count [V].
    pub rms_v: f64,
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

/// Fits from a start, moving only the parameters that are `free`.
///
/// Covariances come from leaving out blocks of rows in turn, so that slowly changing
/// residuals count as few, not as many.
pub fn fit(data: &Data, start: DVector<f64>, free: &[usize], patience: usize) -> Fit {
    let problem = Problem::new(data, free, start);
    let search =
        LevenbergMarquardt::new().with_ftol(1e-9).with_xtol(1e-7).with_patience(patience.max(1));
    let (problem, report) = search.minimize(problem);
    let residual_v = problem.residual();
    let counting = data.weight.iter().sum::<f64>().max(1.0);
    let jacobian = problem.jacobian().unwrap_or_else(|| DMatrix::zeros(data.rows(), free.len()));
    let small = sandwich::covariance(&jacobian, &residual_v, data.rows_per_block);
    let size = problem.parameters.len();
    let mut covariance = DMatrix::zeros(size, size);
    for (i, &row) in free.iter().enumerate() {
        for (j, &column) in free.iter().enumerate() {
            covariance[(row, column)] = small[(i, j)];
        }
    }
    Fit {
        covariance,
        rms_v: (residual_v.norm_squared() / counting).sqrt(),
        residual_v,
        converged: report.termination.was_successful(),
        parameters: problem.parameters,
    }
}

/// RMS residual at given parameters [V].
pub fn rms(data: &Data, parameters: &DVector<f64>) -> f64 {
    const NONE: [usize; 0] = [];
    let problem = Problem::new(data, &NONE, parameters.clone());
    let counting = data.weight.iter().sum::<f64>().max(1.0);
    (problem.residual().norm_squared() / counting).sqrt()
}
