//! Regressors of random states, one below the other.

use model::mechanism::Mechanism;
use nalgebra::DMatrix;
use rand_distr::{Distribution, Uniform};
use rand_pcg::Pcg64Mcg;

/// The states that are drawn, and what counts as nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// How many states. A chain of 10 joints has 110 parameters, of which each state sees at
    /// least one: 60 states of ten torques are five times as many equations.
    pub states: usize,
    /// Positions either way [rad; m]. A full turn shows every harmonic of q.
    pub position: f64,
    /// Velocities either way [rad/s; m/s]. With the next, chosen so that gravity, Coriolis and
    /// inertial torques of an arm of a metre are alike in size.
    pub velocity: f64,
    /// Accelerations either way [rad/s^2; m/s^2].
    pub acceleration: f64,
    /// What is nothing: a column of the regressor relative to the largest, what the others leave of
    /// one relative to itself, and a factor. Angles of model files are rounded, which leaves 1e-8;
    /// what is below 1e-6 of the rest no log can show.
    pub tolerance: f64,
    /// The generator's seed.
    pub seed: u64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            states: 60,
            position: std::f64::consts::PI,
            velocity: 3.0,
            acceleration: 10.0,
            tolerance: 1e-6,
            seed: 1,
        }
    }
}

/// The regressors of random states, (states n) x p, columns scaled to length one.
#[derive(Clone, Debug)]
pub struct Observation {
    /// The matrix; a column of zeros stays one.
    pub matrix: DMatrix<f64>,
    /// What the columns were divided by; 0 for one without effect.
    pub lengths: Vec<f64>,
}

impl Observation {
    /// Of a mechanism whose joints may be anywhere.
    pub fn of(mechanism: &dyn Mechanism<f64>, settings: &Settings) -> Self {
        let (n, p) = (mechanism.joints(), mechanism.parameter_count());
        let mut random = Pcg64Mcg::new(u128::from(settings.seed) << 1 | 1);
        let mut draw = |most: f64| -> Vec<f64> {
            let unit = Uniform::new_inclusive(-1.0, 1.0).expect("a range");
            (0..n).map(|_| most * unit.sample(&mut random)).collect()
        };
        let mut rows = vec![0.0; settings.states * n * p];
        for rows in rows.chunks_exact_mut(n * p) {
            let (q, qd) = (draw(settings.position), draw(settings.velocity));
            mechanism.regressor(&q, &qd, &draw(settings.acceleration), rows);
        }
        Self::scaled(DMatrix::from_row_slice(settings.states * n, p, &rows), settings.tolerance)
    }

    fn scaled(mut matrix: DMatrix<f64>, tolerance: f64) -> Self {
        let mut lengths: Vec<f64> = matrix.column_iter().map(|column| column.norm()).collect();
        let nothing = tolerance * lengths.iter().fold(0.0, |longest: f64, l| longest.max(*l));
        for (mut column, length) in matrix.column_iter_mut().zip(&mut lengths) {
            if *length > nothing {
                column /= *length;
            } else {
                column.fill(0.0);
                *length = 0.0;
            }
        }
        Self { matrix, lengths }
    }
}
