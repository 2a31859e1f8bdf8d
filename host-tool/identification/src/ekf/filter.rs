//! The augmented extended Kalman filter, one pass over a log; states are q, qd, z and the
//! parameters.
//!
//! Parameters have no dynamics of their own; logarithms keep them valid. The state z
//! stands between velocity and friction, so that the sign of the velocity, which
//! changes within a tick, reaches the force over the bristles' travel of tens of
//! ticks: the Jacobians at which the filter linearises stay those of what happens.

use crate::one_joint::dynamics::{Joint, MAX_PARAMETERS, State, Step};
use crate::one_joint::noise::{Innovation, NoiseVariances};
use crate::one_joint::samples::Samples;

const SIZE: usize = 3 + MAX_PARAMETERS;
/// A square matrix over motion and parameters; unused rows are zero.
type Covariance = [[f64; SIZE]; SIZE];

/// Estimated parameters with their standard deviations.
#[derive(Clone, Debug)]
pub struct ParameterEstimate {
    /// Parameters: friction's logarithms, inertia, factors of the linear terms.
    pub parameters: Vec<f64>,
    /// Their standard deviations.
    pub deviation: Vec<f64>,
}

/// The result of a pass.
#[derive(Clone, Debug)]
pub struct FilterPass {
    /// The parameters at the end.
    pub estimate: ParameterEstimate,
    /// Filtered motion at every sample.
    pub states: Vec<State>,
    /// Minus the logarithm of the likelihood, without the constant.
    pub negative_log_likelihood: f64,
    /// Mean of squared innovations over their variance.
    pub normalised: f64,
    /// Root mean square innovation [rad].
    pub innovation_rms_rad: f64,
}

/// One pass of the filter over the samples.
pub fn run(samples: &Samples, start: &ParameterEstimate, noise: &NoiseVariances) -> FilterPass {
    let mut filter = AugmentedFilter::new(samples, start, noise);
    let (mut cost, mut squares, mut sum) = (0.0, 0.0, 0.0);
    let last = samples.time_s.len() - 1;
    let mut states = Vec::with_capacity(last + 1);
    states.push(filter.state);
    for k in 1..=last {
        filter.predict(k - 1);
        let innovation = filter.update(k);
        cost += innovation.negative_log_likelihood();
        squares += innovation.normalised_square();
        sum += innovation.value_rad * innovation.value_rad;
        states.push(filter.state);
    }
    let ticks = last.max(1) as f64;
    FilterPass {
        estimate: filter.estimate(),
        states,
        negative_log_likelihood: cost,
        normalised: squares / ticks,
        innovation_rms_rad: (sum / ticks).sqrt(),
    }
}

struct AugmentedFilter<'a> {
    samples: &'a Samples,
    noise: &'a NoiseVariances,
    state: State,
    parameters: Vec<f64>,
    covariance: Covariance,
}

impl<'a> AugmentedFilter<'a> {
    fn new(samples: &'a Samples, start: &ParameterEstimate, noise: &'a NoiseVariances) -> Self {
        Self {
            samples,
            noise,
            state: State { q_rad: samples.q_rad[0], ..State::default() },
            parameters: start.parameters.clone(),
            covariance: initial_covariance(start, noise),
        }
    }

    /// Predicts sample `k + 1` from sample `k`.
    fn predict(&mut self, k: usize) {
        let (count, step_s) = self.samples.steps(k);
        for _ in 0..count {
            let joint = Joint::new(&self.parameters, &self.samples.regressors);
            let step = joint.step(&self.state, &self.samples.inputs(k, step_s));
            let variance = self.noise.command_over_v2(step_s);
            predict_covariance(&mut self.covariance, &step, variance, self.parameters.len());
            self.state = step.state;
        }
    }

    /// The measurement update with sample `k`.
    fn update(&mut self, k: usize) -> Innovation {
        let row = self.covariance[0];
        let innovation = Innovation {
            value_rad: self.samples.q_rad[k] - self.state.q_rad,
            variance_rad2: row[0] + self.noise.measurement_rad2,
        };
        let gain = row.map(|covariance| covariance / innovation.variance_rad2);
        self.state.correct([gain[0], gain[1], gain[2]], innovation.value_rad);
        for (parameter, gain) in self.parameters.iter_mut().zip(&gain[3..]) {
            *parameter += gain * innovation.value_rad;
        }
        let size = 3 + self.parameters.len();
        for i in 0..size {
            for j in 0..size {
                self.covariance[i][j] -= gain[i] * row[j];
            }
        }
        innovation
    }

    fn estimate(self) -> ParameterEstimate {
        let deviation = |m: usize| self.covariance[3 + m][3 + m].max(0.0).sqrt();
        let deviation = (0..self.parameters.len()).map(deviation).collect();
        ParameterEstimate { parameters: self.parameters, deviation }
    }
}

fn initial_covariance(start: &ParameterEstimate, noise: &NoiseVariances) -> Covariance {
    let mut p = [[0.0; SIZE]; SIZE];
    let bristle_rad = (start.parameters[0] - start.parameters[4]).exp();
    p[0][0] = noise.measurement_rad2;
    p[2][2] = 0.1 * bristle_rad * bristle_rad;
    for (m, deviation) in start.deviation.iter().enumerate() {
        p[3 + m][3 + m] = deviation * deviation;
    }
    p
}

/// P = F P F' + Q where parameters stay and only the motion's three rows move.
fn predict_covariance(p: &mut Covariance, step: &Step, variance: f64, count: usize) {
    let top = motion_rows(p, step, count);
    for i in 0..3 {
        for j in 3..3 + count {
            p[i][j] = top[i][j];
            p[j][i] = top[i][j];
        }
        for j in 0..3 {
            let mut sum = 0.0;
            for m in 0..3 {
                sum += top[i][m] * step.by_state[j][m];
            }
            for m in 0..count {
                sum += top[i][3 + m] * step.by_parameter[j][m];
            }
            p[i][j] = sum + step.by_command[i] * step.by_command[j] * variance;
        }
    }
}

/// The motion's rows of F P.
fn motion_rows(p: &Covariance, step: &Step, count: usize) -> [[f64; SIZE]; 3] {
    let mut top = [[0.0; SIZE]; 3];
    for i in 0..3 {
        for j in 0..3 + count {
            let mut sum = 0.0;
            for m in 0..3 {
                sum += step.by_state[i][m] * p[m][j];
            }
            for m in 0..count {
                sum += step.by_parameter[i][m] * p[3 + m][j];
            }
            top[i][j] = sum;
        }
    }
    top
}
