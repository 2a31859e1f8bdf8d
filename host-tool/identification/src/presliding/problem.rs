//! The least-squares problem of the fit: parameters, residuals, Jacobian.

use std::f64::consts::TAU;

use levenberg_marquardt::LeastSquaresProblem;
use nalgebra::{Complex, DMatrix, DVector, Dyn, Owned, Vector3};

use super::creep::Creep;
use super::linear::LinearRobot;
use super::prior::{Settings, Sliding};
use super::prior_distribution::PriorDistribution;
use super::record::Record;

/// Positions in the parameter vector.
pub mod index {
    /// log sigma_0 over its centre, joints 1 to 3.
    pub const SIGMA0: usize = 0;
    /// log sigma_1 over its centre, joints 1 to 3.
    pub const SIGMA1: usize = 3;
    /// log D_ii over its centre, joints 1 to 3.
    pub const INERTIA: usize = 6;
    /// Change of D_ij over sqrt(D_ii D_jj).
    pub const COUPLING: usize = 9;
    /// log of the creep rate over what is computed for sigma_0.
    pub const CREEP: usize = 12;
    /// Delay over its standard error.
    pub const DELAY: usize = 13;
    /// How many there are.
    pub const COUNT: usize = 14;
}

/// The pairs of neighbours, in the order of their parameters.
const PAIRS: [(usize, usize); 3] = [(0, 1), (0, 2), (1, 2)];
/// One frequency of the fit.
struct FrequencyPoint {
    frequency_hz: f64,
    /// Cross spectra with the instrument, times the weight: commands and angle.
    command: Vector3<Complex<f64>>,
    angle: Complex<f64>,
}

/// The least-squares problem: residuals of the FRF and of the prior.
pub struct Problem<'a> {
    record: &'a Record,
    points: Vec<FrequencyPoint>,
    prior: PriorDistribution,
    creep: Creep,
    creep_error: f64,
    settings: &'a Settings,
    prior_error: [f64; index::COUNT],
    /// Where the solver is.
    pub parameters: DVector<f64>,
}

impl<'a> Problem<'a> {
    /// Residuals over `bins`, weighted by the residual `power` spectrum there.
    pub fn new(
        record: &'a Record,
        bins: &[usize],
        power: &[f64],
        prior: PriorDistribution,
        creep: Creep,
        sliding: Option<&Sliding>,
        settings: &'a Settings,
    ) -> Self {
        let spectra = &record.spectra;
        let variance = spectra.neighbour_inflation / (2.0 * spectra.independent_averages);
        let point = |(&bin, &power): (&usize, &f64)| {
            let weight = 1.0 / (power * record.instrument_power(bin) * variance).sqrt();
            let command = |joint| record.command_by_instrument(bin, joint) * weight;
            FrequencyPoint {
                frequency_hz: spectra.frequency_hz[bin],
                command: Vector3::new(command(0), command(1), command(2)),
                angle: record.angle_by_instrument(bin) * weight,
            }
        };
        let points = bins.iter().zip(power).map(point).collect();
        let creep_error = creep_error(sliding);
        let mut problem = Self {
            record,
            points,
            prior,
            creep,
            creep_error,
            settings,
            prior_error: [1.0; index::COUNT],
            parameters: DVector::zeros(index::COUNT),
        };
        problem.prior_error = problem.prior_errors();
        problem
    }

    fn prior_errors(&self) -> [f64; index::COUNT] {
        let mut errors = [1.0; index::COUNT];
        for joint in 0..3 {
            errors[index::SIGMA0 + joint] = self.prior.sigma0[joint];
            errors[index::SIGMA1 + joint] = self.prior.sigma1[joint];
            errors[index::INERTIA + joint] = self.prior.inertia[joint];
            errors[index::COUPLING + joint] = self.prior.coupling;
        }
        errors[index::CREEP] = self.creep_error;
        errors
    }

    /// The same problem at other parameters.
    pub fn at(mut self, parameters: DVector<f64>) -> Self {
        self.parameters = parameters;
        self
    }

    /// The robot at the parameters.
    pub fn robot(&self) -> LinearRobot {
        let p = &self.parameters;
        let mut robot = self.prior.robot;
        for joint in 0..3 {
            let friction = &mut robot.friction[joint];
            friction.sigma0_v_per_rad *= p[index::SIGMA0 + joint].exp();
            friction.sigma1_v_s_per_rad *= p[index::SIGMA1 + joint].exp();
            robot.mass_kg_m2[joint][joint] *= p[index::INERTIA + joint].exp();
        }
        for (pair, (a, b)) in PAIRS.into_iter().enumerate() {
            let change = p[index::COUPLING + pair] * self.coupling_scale(a, b);
            robot.mass_kg_m2[a][b] += change;
            robot.mass_kg_m2[b][a] += change;
        }
        let own = &mut robot.friction[self.record.excited];
        let rate = self.creep.rate_per_sigma0 * p[index::CREEP].exp();
        own.creep_per_s = own.sigma0_v_per_rad * rate;
        own.drift_share = self.creep.drift_share;
        robot.delay_s = self.settings.delay_s + p[index::DELAY] * self.settings.delay_error_s;
        robot
    }

    fn coupling_scale(&self, a: usize, b: usize) -> f64 {
        let mass = &self.prior.robot.mass_kg_m2;
        (mass[a][a] * mass[b][b]).sqrt()
    }

    /// Weighted residual of one frequency, and its derivatives by the parameters.
    fn at_point(
        &self,
        robot: &LinearRobot,
        point: &FrequencyPoint,
    ) -> Option<(Complex<f64>, [Complex<f64>; index::COUNT])> {
        let s = Complex::new(0.0, TAU * point.frequency_hz);
        let frf = robot.frf(point.frequency_hz, self.record.period_s)?;
        let angles = frf * point.command;
        let row = robot.matrix(s).try_inverse()?.row(self.record.excited).into_owned();
        let residual = point.angle - angles[self.record.excited];
        let mut slope = [Complex::default(); index::COUNT];
        for joint in (0..3).filter(|&joint| robot.present[joint]) {
            self.friction_slopes(robot, joint, s, row[joint] * angles[joint], &mut slope);
        }
        for (pair, (a, b)) in PAIRS.into_iter().enumerate() {
            if robot.present[a] && robot.present[b] {
                let k = &robot.torque_constant_nm_per_v;
                let both = row[a] * angles[b] / k[a] + row[b] * angles[a] / k[b];
                slope[index::COUPLING + pair] = both * s * s * self.coupling_scale(a, b);
            }
        }
        slope[index::DELAY] = angles[self.record.excited] * s * self.settings.delay_error_s;
        Some((residual, slope))
    }

    /// Slopes by the parameters on the diagonal of M; `through` carries a change of
    /// M_jj to the residual.
    fn friction_slopes(
        &self,
        robot: &LinearRobot,
        joint: usize,
        s: Complex<f64>,
        through: Complex<f64>,
        slope: &mut [Complex<f64>; index::COUNT],
    ) {
        let friction = &robot.friction[joint];
        let bristles = friction.bristles(s) * through;
        slope[index::SIGMA0 + joint] = bristles * friction.sigma0_v_per_rad;
        slope[index::SIGMA1 + joint] = bristles * s * friction.sigma1_v_s_per_rad;
        let inertia = robot.mass_kg_m2[joint][joint] / robot.torque_constant_nm_per_v[joint];
        slope[index::INERTIA + joint] = through * s * s * inertia;
        if joint == self.record.excited && friction.creep_per_s > 0.0 {
            let by_creep = friction.impedance_by_log_creep(s) * through;
            slope[index::CREEP] = by_creep;
            slope[index::SIGMA0 + joint] += by_creep;
        }
    }

    /// Mean square of the FRF's residuals over what was expected.
    pub fn misfit(&self) -> Option<f64> {
        let count = 2 * self.points.len();
        let sum: f64 = self.residuals()?.rows(0, count).norm_squared();
        Some(sum * self.record.spectra.neighbour_inflation / count as f64)
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Problem<'_> {
    type ParameterStorage = Owned<f64, Dyn>;
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;

    fn set_params(&mut self, parameters: &DVector<f64>) {
        self.parameters.copy_from(parameters);
    }

    fn params(&self) -> DVector<f64> {
        self.parameters.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let robot = self.robot();
        let count = self.points.len();
        let mut residuals = DVector::zeros(2 * count + index::COUNT);
        for (k, point) in self.points.iter().enumerate() {
            let frf = robot.frf(point.frequency_hz, self.record.period_s)?;
            let predicted = frf.row(self.record.excited).transpose().dot(&point.command);
            residuals[2 * k] = (point.angle - predicted).re;
            residuals[2 * k + 1] = (point.angle - predicted).im;
        }
        for (k, error) in self.prior_error.iter().enumerate() {
            residuals[2 * count + k] = self.parameters[k] / error;
        }
        residuals.iter().all(|r| r.is_finite()).then_some(residuals)
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let robot = self.robot();
        let count = self.points.len();
        let mut jacobian = DMatrix::zeros(2 * count + index::COUNT, index::COUNT);
        for (k, point) in self.points.iter().enumerate() {
            let (_, slope) = self.at_point(&robot, point)?;
            for (column, slope) in slope.iter().enumerate() {
                jacobian[(2 * k, column)] = slope.re;
                jacobian[(2 * k + 1, column)] = slope.im;
            }
        }
        for (k, error) in self.prior_error.iter().enumerate() {
            jacobian[(2 * count + k, k)] = 1.0 / error;
        }
        jacobian.iter().all(|slope| slope.is_finite()).then_some(jacobian)
    }
}

/// Standard error of the logarithm of the computed creep rate.
fn creep_error(sliding: Option<&Sliding>) -> f64 {
    const UNKNOWN: f64 = 2.0;
    const LINEARISATION: f64 = 0.15;
    sliding.map_or(UNKNOWN, |sliding| {
        let level = sliding.alpha0_v.value + sliding.alpha1_v.value.min(0.0);
        let error_v = sliding.alpha0_v.standard_error.hypot(sliding.alpha1_v.standard_error);
        LINEARISATION.hypot(error_v / level.max(1e-3)).clamp(LINEARISATION, UNKNOWN)
    })
}
