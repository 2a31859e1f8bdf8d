//! The augmented filter: states q, qd, z and the parameters, one pass over a log.

use crate::one_joint::innovations::{Noise, Samples};
use crate::one_joint::tick::{Joint, MOST, State, Step};

const SIZE: usize = 3 + MOST;
/// A square matrix over motion and parameters; unused rows are zero.
pub type Covariance = [[f64; SIZE]; SIZE];

/// Where a pass begins, and where it ends.
#[derive(Clone, Debug)]
pub struct Belief {
    /// Parameters: friction's logarithms, inertia, factors of the linear terms.
    pub parameters: Vec<f64>,
    /// Their standard deviations.
    pub deviation: Vec<f64>,
}

/// What a pass leaves behind.
#[derive(Clone, Debug)]
pub struct FilterPass {
    /// Belief at the end.
    pub belief: Belief,
    /// Filtered motion at every sample.
    pub states: Vec<State>,
    /// Half the sum of squared innovations over variance, plus half its logarithm.
    pub cost: f64,
    /// Mean of squared innovations over their variance.
    pub normalised: f64,
    /// Root mean square innovation [rad].
    pub innovation_rms_rad: f64,
}

/// One pass of the extended Kalman filter.
///
/// Parameters have no dynamics of their own; logarithms keep them valid. The state z
/// stands between velocity and friction, so that the sign of the velocity, which
/// changes within a tick, reaches the force over the bristles' travel of tens of
/// ticks: the slopes at which the filter linearises stay those of what happens.
pub fn run(samples: &Samples, start: &Belief, noise: &Noise) -> FilterPass {
    let count = samples.parameters();
    let size = 3 + count;
    let mut parameters = start.parameters.clone();
    let mut state = State { q_rad: samples.q_rad[0], ..State::default() };
    let mut p = initial(start, noise);
    let (mut cost, mut squares, mut sum) = (0.0, 0.0, 0.0);
    let mut states = Vec::with_capacity(samples.time_s.len());
    states.push(state);
    let last = samples.time_s.len() - 1;
    for k in 0..last {
        let (steps, step_s) = samples.steps(k);
        for _ in 0..steps {
            let joint = Joint::new(&parameters, &samples.regressors);
            let step = joint.step(&state, &samples.inputs(k, step_s));
            propagate(&mut p, &step, noise.command_v2 * 1e-3 / step_s, count);
            state = step.state;
        }
        let innovation = samples.q_rad[k + 1] - state.q_rad;
        let variance = p[0][0] + noise.measurement_rad2;
        cost += 0.5 * (innovation * innovation / variance + variance.ln());
        squares += innovation * innovation / variance;
        sum += innovation * innovation;
        let row = p[0];
        let gain = |i: usize| row[i] / variance;
        state.q_rad += gain(0) * innovation;
        state.qd_rad_per_s += gain(1) * innovation;
        state.deflection_rad += gain(2) * innovation;
        for (m, parameter) in parameters.iter_mut().enumerate() {
            *parameter += gain(3 + m) * innovation;
        }
        for i in 0..size {
            let factor = gain(i);
            for j in 0..size {
                p[i][j] -= factor * row[j];
            }
        }
        states.push(state);
    }
    let deviation = (0..count).map(|m| p[3 + m][3 + m].max(0.0).sqrt()).collect();
    let ticks = last.max(1) as f64;
    FilterPass {
        belief: Belief { parameters, deviation },
        states,
        cost,
        normalised: squares / ticks,
        innovation_rms_rad: (sum / ticks).sqrt(),
    }
}

fn initial(start: &Belief, noise: &Noise) -> Covariance {
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
fn propagate(p: &mut Covariance, step: &Step, variance: f64, count: usize) {
    let size = 3 + count;
    let mut top = [[0.0; SIZE]; 3];
    for i in 0..3 {
        for j in 0..size {
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
    for i in 0..3 {
        for j in 3..size {
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
