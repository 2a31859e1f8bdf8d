//! How well a joint's parameters predict its encoder, sample by sample.
//!
//! A Kalman filter on (q, qd, z) with the parameters fixed: its innovations, made small
//! by Gauss-Newton steps, give the maximum-likelihood estimate where the noise enters
//! as torque. No smoothing stands between the data and the nonlinear friction.

use nalgebra::{DMatrix, DVector};

use super::gauss_newton::GaussNewton;
use super::kalman_filter::KalmanFilter;
use super::noise::NoiseVariances;
use super::samples::Samples;
use super::sensitivity::Sensitivity;

/// Length of a block for the standard errors [s].
const BLOCK_S: f64 = 0.5;

/// Innovations of all samples, and the Gauss-Newton equations of their likelihood.
#[derive(Clone, Debug)]
pub struct Innovations {
    squares: f64,
    products: f64,
    equations: GaussNewton,
}

impl Innovations {
    /// Runs the filter over the samples, with the derivatives by the parameters.
    pub fn of(samples: &Samples, parameters: &[f64], noise: &NoiseVariances) -> Self {
        let mut filter = KalmanFilter::new(samples, parameters, noise);
        let mut sensitivity = Sensitivity::new(samples.parameters());
        let mut equations = GaussNewton::new(samples.parameters());
        let (mut squares, mut products, mut previous) = (0.0, 0.0, 0.0);
        let mut block_end_s = samples.time_s[0] + BLOCK_S;
        let last = samples.time_s.len() - 1;
        for k in 1..=last {
            filter.predict(k - 1, |step| sensitivity.predict(step));
            let innovation = filter.innovation(k);
            let gain = filter.gain(&innovation);
            equations.add(sensitivity.of_angle(), &innovation);
            sensitivity.update(gain);
            let normalised = innovation.value_rad / innovation.variance_rad2.sqrt();
            squares += normalised * normalised;
            products += normalised * previous;
            previous = normalised;
            filter.update(gain, &innovation);
            if samples.time_s[k] >= block_end_s || k == last {
                block_end_s += BLOCK_S;
                equations.end_block();
            }
        }
        Self { squares, products, equations }
    }

    /// Autocorrelation of the normalised innovations from sample to sample.
    pub fn correlation(&self) -> f64 {
        self.products / self.squares
    }

    /// The Gauss-Newton step of all parameters; `None` where they are not determined.
    pub fn newton_step(&self) -> Option<DVector<f64>> {
        self.equations.step()
    }

    /// Covariance of all parameters by leaving out blocks in turn.
    pub fn covariance(&self) -> DMatrix<f64> {
        self.equations.covariance()
    }
}

/// Minus the logarithm of the samples' likelihood, without the constant.
fn negative_log_likelihood(samples: &Samples, parameters: &[f64], noise: &NoiseVariances) -> f64 {
    let mut filter = KalmanFilter::new(samples, parameters, noise);
    let mut sum = 0.0;
    for k in 1..samples.time_s.len() {
        filter.predict(k - 1, |_| ());
        let innovation = filter.innovation(k);
        sum += innovation.negative_log_likelihood();
        filter.update(filter.gain(&innovation), &innovation);
    }
    sum
}

/// The voltage noise under which the innovations are most likely: the minimum of a
/// parabola through the negative log-likelihoods at a few levels, each four times the last.
pub fn most_likely_noise(
    samples: &Samples,
    parameters: &[f64],
    noise: NoiseVariances,
) -> NoiseVariances {
    const FACTOR: f64 = 4.0;
    const MOST_ROUNDS: usize = 6;
    let at = |command_v2: f64| {
        negative_log_likelihood(samples, parameters, &NoiseVariances { command_v2, ..noise })
    };
    let mut level = noise.command_v2;
    let mut costs = [at(level / FACTOR), at(level), at(level * FACTOR)];
    for _ in 0..MOST_ROUNDS {
        if costs[0] < costs[1] {
            level /= FACTOR;
            costs = [at(level / FACTOR), costs[0], costs[1]];
        } else if costs[2] < costs[1] {
            level *= FACTOR;
            costs = [costs[1], costs[2], at(level * FACTOR)];
        } else {
            break;
        }
    }
    let bend = costs[0] - 2.0 * costs[1] + costs[2];
    let shift = if bend > 0.0 { 0.5 * (costs[0] - costs[2]) / bend } else { 0.0 };
    NoiseVariances { command_v2: level * FACTOR.powf(shift.clamp(-1.0, 1.0)), ..noise }
}
