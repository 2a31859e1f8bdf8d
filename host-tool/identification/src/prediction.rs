//! The motion that a model predicts from the recorded commands, window by window.
//!
//! Over a whole log a simulation without feedback drifts away like a double integrator,
//! however good the model. So it begins anew from the measured state every quarter
//! second; what is compared is how far it has drifted within a window.

use model::{FrictionState, Robot};
use rayon::prelude::*;
use serde::Serialize;

use recordings::StepError;
use recordings::campaign::Trace;
use recordings::motion::{Instant, Motion};
use signal::rms;
use simulation::{Settings, SimulatedRobot};

/// Length of a window [s].
const WINDOW_S: f64 = 0.25;
/// Where the measured motion is cut off that windows begin from [Hz].
const CUTOFF_HZ: f64 = 60.0;

/// Predicted motion of all joints over an unbroken stretch of a log.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Prediction {
    /// Instants [s].
    pub time_s: Vec<f64>,
    /// Measured angles of the three joints [rad].
    pub measured_rad: [Vec<f64>; 3],
    /// Predicted less measured angles of the three joints [rad].
    pub error_rad: [Vec<f64>; 3],
}

impl Prediction {
    /// Root mean square of each joint's error [rad].
    pub fn rms_rad(&self) -> [f64; 3] {
        [0, 1, 2].map(|joint| rms(&self.error_rad[joint]))
    }
}

/// Predicts a log's motion.
///
/// # Errors
/// A log that lacks a joint or is nowhere unbroken for a second.
pub fn predict(trace: &Trace, robot: &Robot<f64>) -> Result<Vec<Prediction>, StepError> {
    predict_over(trace, robot, WINDOW_S)
}

/// [`predict`] with windows of another length; an infinite one simulates the whole log
/// from its beginning, as Fig. 5 does.
///
/// # Errors
/// Those of [`predict`].
pub fn predict_over(
    trace: &Trace,
    robot: &Robot<f64>,
    window_s: f64,
) -> Result<Vec<Prediction>, StepError> {
    let stretches = Motion::stretches(trace, CUTOFF_HZ, Instant::Sample)?;
    Ok(stretches.iter().map(|motion| of_motion(motion, robot, window_s)).collect())
}

fn of_motion(motion: &Motion, robot: &Robot<f64>, window_s: f64) -> Prediction {
    let window = ((window_s / motion.period_s).round() as usize).clamp(1, motion.len());
    let bristles = bristles(motion, robot);
    let starts: Vec<usize> = (0..motion.len()).step_by(window).collect();
    let drifts: Vec<Vec<[f64; 3]>> = starts
        .par_iter()
        .map(|&start| {
            let end = (start + window).min(motion.len());
            drift(motion, robot, start..end, &bristles[start])
        })
        .collect();
    let errors: Vec<[f64; 3]> = drifts.into_iter().flatten().collect();
    Prediction {
        time_s: (0..motion.len()).map(|k| motion.start_s + k as f64 * motion.period_s).collect(),
        measured_rad: motion.q_rad.clone(),
        error_rad: [0, 1, 2].map(|joint| errors.iter().map(|error| error[joint]).collect()),
    }
}

/// Predicted less measured angles over a window [rad].
fn drift(
    motion: &Motion,
    robot: &Robot<f64>,
    range: std::ops::Range<usize>,
    bristles: &[FrictionState<f64>; 3],
) -> Vec<[f64; 3]> {
    let settings =
        Settings { sample_period_s: motion.period_s, noise_v: 0.0, ..Settings::default() };
    let (q, qd, qdd) = motion.state(range.start);
    let mut simulated = SimulatedRobot::at_rest(*robot, q, &settings);
    simulated.set_motion(qd, qdd, *bristles);
    range
        .map(|k| {
            let error = [0, 1, 2].map(|i| simulated.q_rad()[i] - motion.q_rad[i][k]);
            simulated.advance(&[0, 1, 2].map(|i| motion.command_v[i][k]));
            error
        })
        .collect()
}

/// The bristles' state at every instant, driven by the measured velocity.
fn bristles(motion: &Motion, robot: &Robot<f64>) -> Vec<[FrictionState<f64>; 3]> {
    let mut state = [FrictionState::default(); 3];
    (0..motion.len())
        .map(|k| {
            let before = state;
            for i in 0..3 {
                let velocity = motion.qd_rad_per_s[i][k];
                state[i].step(&robot.friction[i], velocity, motion.period_s);
            }
            before
        })
        .collect()
}
