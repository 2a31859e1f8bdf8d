//! The motion that a model predicts from the commands of the logs held out.
//!
//! A simulation without feedback drifts away, however good the model, so it begins anew from
//! the measured state every quarter second; what counts is how far it has drifted by then.

use model::FrictionState;
use rayon::prelude::*;

use crate::logs::stretch::Stretch;
use crate::rows::evidence::Evidence;
use crate::trial::equation::Trial;
use crate::trial::hypothesis::{EffectInstance, Hypothesis};
use files::Role;
use simulation::{Settings, SimulatedRobot};

/// Length of a window [s].
const WINDOW_S: f64 = 0.25;
/// Commands before a window that fill lags and delays [s].
const BEFORE_S: f64 = 0.1;

/// Root mean square of each joint's drift on the logs held out [rad].
pub fn drift_rms_rad(evidence: &Evidence, hypothesis: &Hypothesis) -> Vec<f64> {
    let held: Vec<&Stretch> =
        evidence.stretches.iter().filter(|stretch| stretch.role == Role::Holdout).collect();
    let sums: Vec<([f64; 3], usize)> =
        held.par_iter().flat_map_iter(|stretch| windows(stretch, hypothesis)).collect();
    let count: usize = sums.iter().map(|sum| sum.1).sum();
    let squares = |joint: usize| sums.iter().map(|sum| sum.0[joint]).sum::<f64>();
    let rms = |&joint: &usize| (squares(joint) / count.max(1) as f64).sqrt();
    evidence.joints.iter().map(rms).collect()
}

/// Squares of the drift in each window, and samples in it.
fn windows(stretch: &Stretch, hypothesis: &Hypothesis) -> Vec<([f64; 3], usize)> {
    let window = (WINDOW_S / stretch.period_s).round().max(2.0) as usize;
    let trial = Trial::of(stretch, hypothesis);
    let bristles = trial.bristles();
    let starts = (window..stretch.len().saturating_sub(window)).step_by(window);
    starts
        .map(|start| (drift(stretch, hypothesis, &trial, start, window, &bristles), window))
        .collect()
}

fn drift(
    stretch: &Stretch,
    hypothesis: &Hypothesis,
    trial: &Trial,
    start: usize,
    window: usize,
    bristles: &[[FrictionState<f64>; 3]],
) -> [f64; 3] {
    let settings =
        Settings { sample_period_s: stretch.period_s, noise_v: 0.0, ..Settings::default() };
    let effects = hypothesis.effects.iter().filter_map(EffectInstance::build).collect();
    let (q, qd, qdd) = trial.motor().state(start);
    let mut robot = SimulatedRobot::with_effects(hypothesis.robot, effects, q, &settings);
    let time_s = stretch.start_s + start as f64 * stretch.period_s;
    let command = |k: usize| [0, 1, 2].map(|i| stretch.command_v[i][k]);
    let before = (BEFORE_S / stretch.period_s).ceil() as usize;
    for k in start.saturating_sub(before)..start {
        robot.feel(&command(k));
    }
    robot.set_time(time_s);
    robot.set_motion(qd, qdd, bristles[start]);
    let mut squares = [0.0; 3];
    for k in start..start + window {
        let reading = robot.reading_rad();
        for joint in 0..3 {
            squares[joint] += (reading[joint] - stretch.motion.raw_rad[joint][k]).powi(2);
        }
        robot.advance(&command(k));
    }
    squares
}
