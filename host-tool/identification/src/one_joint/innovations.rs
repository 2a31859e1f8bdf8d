//! How well a joint's parameters predict its encoder, tick by tick.
//!
//! A Kalman filter on (q, qd, z) with the parameters fixed: its innovations, made small
//! by Gauss-Newton steps, give the maximum-likelihood estimate where the noise enters
//! as torque. No smoothing stands between the data and the nonlinear friction.

use nalgebra::{DMatrix, DVector};
use serde::Serialize;

use super::sandwich;
use super::tick::{Inputs, Joint, MOST, Regressor, State};

/// A joint's samples and what acts on it from outside.
#[derive(Clone, Debug, Default)]
pub struct Samples {
    /// Times [s].
    pub time_s: Vec<f64>,
    /// Measured angle [rad].
    pub q_rad: Vec<f64>,
    /// Command from each sample on [V].
    pub command_v: Vec<f64>,
    /// Angle of what carries the joint [rad]; empty where nothing does.
    pub carried_rad: Vec<f64>,
    /// Signals from outside at each sample; empty where there are none.
    pub signals: Vec<Vec<f64>>,
    /// What the linear terms multiply.
    pub regressors: Vec<Regressor>,
}

/// What the filter believes of the noises.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Noise {
    /// Variance of a measured angle [rad^2].
    pub measurement_rad2: f64,
    #[serde(rename = "command_V2")]
    /// Voltage noise, white with the rate of the ticks: variance over a millisecond [V^2].
    pub command_v2: f64,
}

impl Samples {
    /// How many parameters the joint has.
    pub fn parameters(&self) -> usize {
        super::tick::INERTIA + 1 + self.regressors.len()
    }

    /// What acts from sample `k` to the next, in steps of at most a few milliseconds.
    pub(crate) fn inputs(&self, k: usize, step_s: f64) -> Inputs<'_> {
        Inputs {
            command_v: self.command_v[k],
            step_s,
            carried_rad: self.carried_rad.get(k).copied().unwrap_or(0.0),
            signals: self.signals.get(k).map_or(&[], |s| s.as_slice()),
        }
    }

    /// Number and length of the steps from sample `k` to the next.
    pub(crate) fn steps(&self, k: usize) -> (usize, f64) {
        const LONGEST_S: f64 = 2.5e-3;
        let interval_s = self.time_s[k + 1] - self.time_s[k];
        let count = (interval_s / LONGEST_S).ceil().max(1.0);
        (count as usize, interval_s / count)
    }
}

impl Samples {
    /// The samples from one index to before another.
    pub fn part(&self, from: usize, to: usize) -> Self {
        let to = to.min(self.time_s.len());
        let cut = |values: &[f64]| values.get(from..to).map_or_else(Vec::new, <[f64]>::to_vec);
        Self {
            time_s: cut(&self.time_s),
            q_rad: cut(&self.q_rad),
            command_v: cut(&self.command_v),
            carried_rad: cut(&self.carried_rad),
            signals: self.signals.get(from..to).map_or_else(Vec::new, <[Vec<f64>]>::to_vec),
            regressors: self.regressors.clone(),
        }
    }
}

/// The voltage noise under which the innovations are most likely: the minimum of a
/// parabola through the costs at a few levels, each four times the last.
pub fn tuned(samples: &Samples, parameters: &[f64], noise: Noise) -> Noise {
    const FACTOR: f64 = 4.0;
    const MOST_ROUNDS: usize = 6;
    let at = |command_v2: f64| {
        pass(samples, parameters, &Noise { command_v2, ..noise }, Wanted::Cost).cost
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
    Noise { command_v2: level * FACTOR.powf(shift.clamp(-1.0, 1.0)), ..noise }
}

/// Likelihood of the samples and its slopes.
#[derive(Clone, Debug)]
pub struct Pass {
    /// Half the sum of squared innovations over their variance, plus half its logarithm.
    pub cost: f64,
    /// Mean of squared innovations over their variance; 1 when the noises are right.
    pub normalised: f64,
    /// Autocorrelation of the normalised innovations from tick to tick.
    pub correlation: f64,
    /// Per block: Gauss-Newton matrix and score.
    blocks: Vec<(DMatrix<f64>, DVector<f64>)>,
    /// Filtered states, where they were asked for.
    pub states: Vec<State>,
}

/// What a pass is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// The likelihood alone.
    Cost,
    /// Slopes by the parameters as well.
    Slopes,
    /// The filtered motion.
    States,
}

/// Runs the filter over the samples.
pub fn pass(samples: &Samples, parameters: &[f64], noise: &Noise, wanted: Wanted) -> Pass {
    const BLOCK_S: f64 = 0.5;
    let joint = Joint::new(parameters, &samples.regressors);
    let count = samples.parameters();
    let mut state = State { q_rad: samples.q_rad[0], ..State::default() };
    let bristle_rad = joint.friction().alpha0_v / joint.friction().sigma0_v_per_rad;
    let mut p = [[0.0; 3]; 3];
    p[0][0] = noise.measurement_rad2;
    p[2][2] = 0.1 * bristle_rad * bristle_rad;
    let mut s = [[0.0; MOST]; 3];
    let (mut cost, mut squares, mut products, mut last) = (0.0, 0.0, 0.0, 0.0);
    let mut hessian = [[0.0; MOST]; MOST];
    let mut score = [0.0; MOST];
    let mut blocks = Vec::new();
    let mut block_end_s = samples.time_s[0] + BLOCK_S;
    let mut states = Vec::new();
    if wanted == Wanted::States {
        states.reserve(samples.time_s.len());
        states.push(state);
    }
    for k in 0..samples.time_s.len() - 1 {
        let (steps, step_s) = samples.steps(k);
        for _ in 0..steps {
            let step = joint.step(&state, &samples.inputs(k, step_s));
            let variance = noise.command_v2 * 1e-3 / step_s;
            p = propagate(&p, &step.by_state, &step.by_command, variance);
            if wanted == Wanted::Slopes {
                let old = s;
                for i in 0..3 {
                    for m in 0..count {
                        s[i][m] = step.by_parameter[i][m]
                            + step.by_state[i][0] * old[0][m]
                            + step.by_state[i][1] * old[1][m]
                            + step.by_state[i][2] * old[2][m];
                    }
                }
            }
            state = step.state;
        }
        let innovation = samples.q_rad[k + 1] - state.q_rad;
        let variance = p[0][0] + noise.measurement_rad2;
        let gain = [p[0][0] / variance, p[1][0] / variance, p[2][0] / variance];
        if wanted == Wanted::Slopes {
            let slope = s[0];
            for m in 0..count {
                let weighted = slope[m] / variance;
                score[m] += weighted * innovation;
                for n in 0..=m {
                    hessian[m][n] += weighted * slope[n];
                }
            }
            for i in 0..3 {
                for m in 0..count {
                    s[i][m] -= gain[i] * slope[m];
                }
            }
        }
        cost += 0.5 * (innovation * innovation / variance + variance.ln());
        let normalised = innovation / variance.sqrt();
        squares += normalised * normalised;
        products += normalised * last;
        last = normalised;
        state.q_rad += gain[0] * innovation;
        state.qd_rad_per_s += gain[1] * innovation;
        state.deflection_rad += gain[2] * innovation;
        let row = p[0];
        for i in 0..3 {
            for j in 0..3 {
                p[i][j] -= gain[i] * row[j];
            }
        }
        if wanted == Wanted::States {
            states.push(state);
        }
        if samples.time_s[k + 1] >= block_end_s || k + 2 == samples.time_s.len() {
            block_end_s += BLOCK_S;
            if wanted == Wanted::Slopes {
                let symmetric = |m: usize, n: usize| hessian[m.max(n)][m.min(n)];
                blocks.push((
                    DMatrix::from_fn(count, count, symmetric),
                    DVector::from_fn(count, |m, _| score[m]),
                ));
                (hessian, score) = ([[0.0; MOST]; MOST], [0.0; MOST]);
            }
        }
    }
    let ticks = (samples.time_s.len() - 1) as f64;
    Pass { cost, normalised: squares / ticks, correlation: products / squares, blocks, states }
}

/// P = F P F' + g g' variance.
fn propagate(p: &[[f64; 3]; 3], f: &[[f64; 3]; 3], g: &[f64; 3], variance: f64) -> [[f64; 3]; 3] {
    let mut fp = [[0.0; 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            fp[i][j] = f[i][0] * p[0][j] + f[i][1] * p[1][j] + f[i][2] * p[2][j];
        }
    }
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

impl Pass {
    /// Sum of the blocks' Gauss-Newton matrices and scores.
    fn total(&self) -> (DMatrix<f64>, DVector<f64>) {
        let (first, rest) = self.blocks.split_first().expect("a pass with slopes has a block");
        let mut total = first.clone();
        for (hessian, score) in rest {
            total.0 += hessian;
            total.1 += score;
        }
        total
    }

    /// The Gauss-Newton step of the parameters that may move, damped as Marquardt has it.
    pub fn newton_step(&self, free: &[usize], damping: f64) -> Option<DVector<f64>> {
        let (hessian, score) = self.total();
        let (mut small, score) = chosen(&hessian, &score, free);
        for i in 0..free.len() {
            small[(i, i)] *= 1.0 + damping;
        }
        Some(sandwich::scaled_inverse(&small, &small)? * score)
    }

    /// Covariance of the free parameters by leaving out blocks in turn.
    pub fn covariance(&self, free: &[usize]) -> DMatrix<f64> {
        let (hessian, score) = self.total();
        let whole = chosen(&hessian, &score, free).0;
        let blocks = self.blocks.iter().map(|(h, g)| chosen(h, g, free));
        sandwich::jackknife(&whole, blocks)
    }
}

fn chosen(
    hessian: &DMatrix<f64>,
    score: &DVector<f64>,
    free: &[usize],
) -> (DMatrix<f64>, DVector<f64>) {
    let size = free.len();
    (
        DMatrix::from_fn(size, size, |i, j| hessian[(free[i], free[j])]),
        DVector::from_fn(size, |i, _| score[free[i]]),
    )
}
