//! The extended Kalman filter of a joint whose parameters are fixed; states are (q, qd, z).

use model::vector::Matrix3;

use super::dynamics::{Joint, State, Step};
use super::noise::{Innovation, NoiseVariances};
use super::samples::Samples;

/// The filter at one sample.
pub struct KalmanFilter<'a> {
    samples: &'a Samples,
    joint: Joint<'a>,
    noise: &'a NoiseVariances,
    state: State,
    covariance: Matrix3<f64>,
}

impl<'a> KalmanFilter<'a> {
    /// At the first sample: at rest, the deflection of the bristles unknown.
    pub fn new(samples: &'a Samples, parameters: &'a [f64], noise: &'a NoiseVariances) -> Self {
        let joint = Joint::new(parameters, &samples.regressors);
        let bristle_rad = joint.friction().alpha0_v / joint.friction().sigma0_v_per_rad;
        let mut covariance = [[0.0; 3]; 3];
        covariance[0][0] = noise.measurement_rad2;
        covariance[2][2] = 0.1 * bristle_rad * bristle_rad;
        let state = State { q_rad: samples.q_rad[0], ..State::default() };
        Self { samples, joint, noise, state, covariance }
    }

    /// Predicts sample `k + 1` from sample `k`; `each` sees every step on the way.
    pub fn predict(&mut self, k: usize, mut each: impl FnMut(&Step)) {
        let (count, step_s) = self.samples.steps(k);
        for _ in 0..count {
            let step = self.joint.step(&self.state, &self.samples.inputs(k, step_s));
            self.covariance = predicted_covariance(
                &self.covariance,
                &step.by_state,
                &step.by_command,
                self.noise.command_over_v2(step_s),
            );
            each(&step);
            self.state = step.state;
        }
    }

    /// Measured less predicted angle of sample `k`.
    pub fn innovation(&self, k: usize) -> Innovation {
        Innovation {
            value_rad: self.samples.q_rad[k] - self.state.q_rad,
            variance_rad2: self.covariance[0][0] + self.noise.measurement_rad2,
        }
    }

    /// The Kalman gain K = P H' / S of an innovation of variance S.
    pub fn gain(&self, innovation: &Innovation) -> [f64; 3] {
        [0, 1, 2].map(|i| self.covariance[i][0] / innovation.variance_rad2)
    }

    /// The measurement update: x + K times innovation, P - K H P.
    pub fn update(&mut self, gain: [f64; 3], innovation: &Innovation) {
        self.state.correct(gain, innovation.value_rad);
        let row = self.covariance[0];
        for i in 0..3 {
            for j in 0..3 {
                self.covariance[i][j] -= gain[i] * row[j];
            }
        }
    }
}

/// F P F' + g g' times the variance of the command.
fn predicted_covariance(
    p: &Matrix3<f64>,
    f: &Matrix3<f64>,
    g: &[f64; 3],
    variance: f64,
) -> Matrix3<f64> {
    let fp = [0, 1, 2]
        .map(|i| [0, 1, 2].map(|j| f[i][0] * p[0][j] + f[i][1] * p[1][j] + f[i][2] * p[2][j]));
    let mut out = [[0.0; 3]; 3];
    for i in 0..3 {
        for j in 0..=i {
            let value = fp[i][0] * f[j][0] + fp[i][1] * f[j][1] + fp[i][2] * f[j][2];
            out[i][j] = value + g[i] * g[j] * variance;
            out[j][i] = out[i][j];
        }
    }
    out
}
