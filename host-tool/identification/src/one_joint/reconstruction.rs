//! A joint's motion from its encoder and its command together.
//!
//! A Kalman filter and the smoother of Rauch, Tung and Striebel on
//! J qdd = u - f, where f, everything that is not command, is a random walk: where the
//! command excites the joint, its motion is known far better than the encoder alone
//! resolves, and no friction model is needed.

use model::vector::{self, Matrix3};

use recordings::smoothed::{SmoothedMotion, typical_period_s};

/// The smoother's model of the joint and of its noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmootherSettings {
    /// Inertia in volts per acceleration [V s^2/rad].
    pub inertia: f64,
    /// Variance of a measured angle [rad^2].
    pub measurement_rad2: f64,
    /// Standard deviation of f's change per radian that the joint moves [V/rad].
    pub stiffness_v_per_rad: f64,
    /// Its least and its largest value over a millisecond [V].
    pub random_walk_v: [f64; 2],
}

/// Mean and covariance of (q, qd, f).
#[derive(Clone, Copy, Debug, Default)]
struct StateEstimate {
    x: [f64; 3],
    p: Matrix3<f64>,
}

/// Reconstructs the motion and averages `stride` samples to a point.
///
/// Empty where there are fewer than two samples.
pub fn reconstructed(
    time_s: &[f64],
    q_rad: &[f64],
    command_v: &[f64],
    settings: &SmootherSettings,
    stride: usize,
) -> SmoothedMotion {
    if time_s.len() < 2 {
        return SmoothedMotion::default();
    }
    let smoother = Smoother {
        time_s,
        q_rad,
        command_v,
        settings,
        random_walk_v2: random_walk_v2(time_s, q_rad, settings),
    };
    let states = smoother.backward(&smoother.forward());
    averaged(time_s, command_v, &states, settings.inertia, stride)
}

struct Smoother<'a> {
    time_s: &'a [f64],
    q_rad: &'a [f64],
    command_v: &'a [f64],
    settings: &'a SmootherSettings,
    random_walk_v2: Vec<f64>,
}

impl Smoother<'_> {
    /// The state a sample later.
    fn advance(&self, x: &[f64; 3], k: usize) -> [f64; 3] {
        let f = self.transition(k);
        let push = self.command_v[k];
        [x[0] + f[0][1] * x[1] + f[0][2] * (x[2] - push), x[1] + f[1][2] * (x[2] - push), x[2]]
    }

    fn transition(&self, k: usize) -> Matrix3<f64> {
        let h = self.time_s[k + 1] - self.time_s[k];
        let j = self.settings.inertia;
        [[1.0, h, -h * h / (2.0 * j)], [0.0, 1.0, -h / j], [0.0, 0.0, 1.0]]
    }

    /// Covariance a sample later.
    fn predicted_covariance(&self, p: &Matrix3<f64>, k: usize) -> Matrix3<f64> {
        let f = self.transition(k);
        let mut out = product_transposed(&product(&f, p), &f);
        out[2][2] += self.random_walk_v2[k];
        out
    }

    fn first(&self) -> StateEstimate {
        const VELOCITY_RAD_PER_S: f64 = 0.01;
        const FRICTION_V: f64 = 1.0;
        let mut p = [[0.0; 3]; 3];
        p[0][0] = self.settings.measurement_rad2;
        p[1][1] = VELOCITY_RAD_PER_S * VELOCITY_RAD_PER_S;
        p[2][2] = FRICTION_V * FRICTION_V;
        StateEstimate { x: [self.q_rad[0], 0.0, self.command_v[0]], p }
    }

    fn forward(&self) -> Vec<StateEstimate> {
        let mut now = self.first();
        let mut filtered = Vec::with_capacity(self.time_s.len());
        filtered.push(now);
        for k in 0..self.time_s.len() - 1 {
            let (x, p) = (self.advance(&now.x, k), self.predicted_covariance(&now.p, k));
            let variance = p[0][0] + self.settings.measurement_rad2;
            let innovation = self.q_rad[k + 1] - x[0];
            now.x = [0, 1, 2].map(|i| x[i] + p[i][0] / variance * innovation);
            now.p = [0, 1, 2].map(|i| [0, 1, 2].map(|j| p[i][j] - p[i][0] / variance * p[0][j]));
            filtered.push(now);
        }
        filtered
    }

    /// The means given all samples: x + P F' P-^-1 (x smoothed - x predicted), from the
    /// end to the beginning.
    fn backward(&self, filtered: &[StateEstimate]) -> Vec<[f64; 3]> {
        let mut states: Vec<[f64; 3]> = filtered.iter().map(|state| state.x).collect();
        for k in (0..states.len() - 1).rev() {
            let StateEstimate { x, p } = filtered[k];
            let predicted = self.advance(&x, k);
            let difference = [0, 1, 2].map(|i| states[k + 1][i] - predicted[i]);
            let f = self.transition(k);
            let weighted = vector::solve_symmetric(&self.predicted_covariance(&p, k), &difference);
            let back = [0, 1, 2].map(|i| (0..3).map(|j| f[j][i] * weighted[j]).sum());
            let step = vector::multiply(&p, &back);
            states[k] = [0, 1, 2].map(|i| x[i] + step[i]);
        }
        states
    }
}

/// Points of the motion: velocities are differences of positions, so that they add up.
fn averaged(
    time_s: &[f64],
    command_v: &[f64],
    states: &[[f64; 3]],
    inertia: f64,
    stride: usize,
) -> SmoothedMotion {
    const GAP_IN_PERIODS: f64 = 3.0;
    let period_s = typical_period_s(time_s);
    let mut motion =
        SmoothedMotion { step_s: stride as f64 * period_s, ..SmoothedMotion::default() };
    for begin in (0..states.len().saturating_sub(stride)).step_by(stride) {
        let end = begin + stride;
        let span_s = time_s[end] - time_s[begin];
        let mean = |f: &dyn Fn(usize) -> f64| (begin..end).map(f).sum::<f64>() / stride as f64;
        motion.time_s.push(0.5 * (time_s[begin] + time_s[end]));
        motion.q_rad.push(0.5 * (states[begin][0] + states[end][0]));
        motion.qd_rad_per_s.push((states[end][0] - states[begin][0]) / span_s);
        motion.qdd_rad_per_s2.push(mean(&|k| (command_v[k] - states[k][2]) / inertia));
        motion.command_v.push(mean(&|k| command_v[k]));
        motion.measured.push(span_s < GAP_IN_PERIODS * stride as f64 * period_s);
    }
    motion
}

/// Variance of f's change from each sample to the next [V^2]: what friction changes over
/// the distance travelled, within limits.
fn random_walk_v2(time_s: &[f64], q_rad: &[f64], settings: &SmootherSettings) -> Vec<f64> {
    const REACH: usize = 8;
    let last = q_rad.len() - 1;
    (0..last)
        .map(|k| {
            let (from, to) = (k.saturating_sub(REACH), (k + REACH).min(last));
            let speed = (q_rad[to] - q_rad[from]).abs() / (time_s[to] - time_s[from]);
            let milliseconds = (time_s[k + 1] - time_s[k]) / 1e-3;
            let per_ms = settings.stiffness_v_per_rad * speed * 1e-3;
            let per_ms = per_ms.clamp(settings.random_walk_v[0], settings.random_walk_v[1]);
            per_ms * per_ms * milliseconds
        })
        .collect()
}

/// a b
fn product(a: &Matrix3<f64>, b: &Matrix3<f64>) -> Matrix3<f64> {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j]))
}

/// a b'
fn product_transposed(a: &Matrix3<f64>, b: &Matrix3<f64>) -> Matrix3<f64> {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| a[i][0] * b[j][0] + a[i][1] * b[j][1] + a[i][2] * b[j][2]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_excited_joint_is_seen_below_the_encoder_step() {
        const INERTIA: f64 = 0.02;
        let step_rad = 9.6e-6;
        let time_s: Vec<f64> = (0..4000).map(|k| 1e-3 * f64::from(k)).collect();
        // u = f + J qdd of a slow drift with a vibration of 30 Hz, a third of an encoder step.
        let truth = |t: f64| 1e-3 * t + 3e-6 * (188.5 * t).sin();
        let velocity = |t: f64| 1e-3 + 3e-6 * 188.5 * (188.5 * t).cos();
        let command = |t: f64| 0.1 - INERTIA * 3e-6 * 188.5f64.powi(2) * (188.5 * t).sin();
        let q: Vec<f64> =
            time_s.iter().map(|&t| (truth(t) / step_rad).round() * step_rad).collect();
        let u: Vec<f64> = time_s.iter().map(|&t| command(t + 0.5e-3)).collect();
        let settings = SmootherSettings {
            inertia: INERTIA,
            measurement_rad2: step_rad * step_rad / 12.0,
            stiffness_v_per_rad: 200.0,
            random_walk_v: [1e-4, 5e-3],
        };
        let motion = reconstructed(&time_s, &q, &u, &settings, 2);
        let errors = (200..1800).map(|k| motion.qd_rad_per_s[k] - velocity(motion.time_s[k]));
        let rms = (errors.map(|e| e * e).sum::<f64>() / 1600.0).sqrt();
        assert!(rms < 1.5e-4, "{rms:e} rad/s of a vibration of 4e-4");
    }
}
