//! The motion that a model predicts from the commands of the logs held out.
//!
//! A simulation without feedback drifts away, however good the model, so it restarts from
//! the measured state every quarter second; what counts is how far it has drifted by then.

use std::ops::Range;

use model::FrictionState;
use rayon::prelude::*;

use crate::criteria::Criteria;
use crate::logs::kinematics::Joints;
use crate::logs::stretch::Stretch;
use crate::rows::evidence::Evidence;
use crate::trial::equation::Trial;
use crate::trial::held_warmth::with_held_warmth;
use crate::trial::hypothesis::Hypothesis;
use files::Role;
use simulation::{Settings, SimulatedPlant};

/// Root mean square of each joint's drift on the logs held out [rad].
pub fn drift_rms_rad(evidence: &Evidence, hypothesis: &Hypothesis) -> Vec<f64> {
    let hypothesis = with_held_warmth(evidence, hypothesis);
    let held: Vec<&Stretch> =
        evidence.stretches.iter().filter(|stretch| stretch.role == Role::Holdout).collect();
    let sums: Vec<(Joints, usize)> = held
        .par_iter()
        .flat_map_iter(|stretch| {
            let middle_s = stretch.start_s + 0.5 * stretch.duration_s();
            let hypothesis = hypothesis.as_warm_as_in(stretch.log, middle_s);
            windows(stretch, &hypothesis, &evidence.criteria)
        })
        .collect();
    let count: usize = sums.iter().map(|sum| sum.1).sum();
    let squares = |joint: usize| sums.iter().map(|sum| sum.0[joint]).sum::<f64>();
    let rms = |&joint: &usize| (squares(joint) / count.max(1) as f64).sqrt();
    evidence.joints.iter().map(rms).collect()
}

/// Squares of the drift in each window, and samples in it; a window begins where those before it
/// have filled lags and delays.
fn windows(
    stretch: &Stretch,
    hypothesis: &Hypothesis,
    criteria: &Criteria,
) -> Vec<(Joints, usize)> {
    let window = (criteria.verdict.drift_window_s / stretch.period_s).round().max(2.0) as usize;
    let trial = Trial::of(stretch, hypothesis, &criteria.fit);
    let bristles = trial.bristles();
    let starts = (window..stretch.len().saturating_sub(window)).step_by(window);
    let before = (criteria.verdict.drift_before_s / stretch.period_s).ceil() as usize;
    starts
        .map(|start| {
            let range = start..start + window;
            (drift(stretch, hypothesis, &trial, range, before, &bristles[start]), window)
        })
        .collect()
}

fn drift(
    stretch: &Stretch,
    hypothesis: &Hypothesis,
    trial: &Trial,
    range: Range<usize>,
    before: usize,
    bristles: &[FrictionState<f64>],
) -> Joints {
    let start = range.start;
    let settings =
        Settings { sample_period_s: stretch.period_s, noise_v: 0.0, ..Settings::default() };
    let effects = hypothesis.built_effects();
    let [q, qd, qdd] = trial.motor().state(start);
    let (plant, joints) = (hypothesis.plant.clone(), hypothesis.plant.joints());
    let mut robot = SimulatedPlant::with_effects(plant, effects, &q[..joints], &settings);
    let time_s = stretch.start_s + start as f64 * stretch.period_s;
    let command = |k: usize| {
        let mut command_v = Joints::default();
        (0..joints).for_each(|i| command_v[i] = stretch.command_v[i][k]);
        command_v
    };
    for k in start.saturating_sub(before)..start {
        robot.update_effects_at_rest(&command(k)[..joints]);
    }
    robot.set_time(time_s);
    robot.set_motion(&qd, &qdd, bristles);
    let mut squares = Joints::default();
    for k in range {
        let reading = robot.reading_rad();
        for joint in 0..joints {
            squares[joint] += (reading[joint] - stretch.motion.raw_rad[joint][k]).powi(2);
        }
        robot.advance(&command(k)[..joints]);
    }
    squares
}
