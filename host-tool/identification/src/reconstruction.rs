//! The command that a model needs for a recorded motion, Fig. 8 and 10.

use model::{Posture, Robot};
use serde::Serialize;

use super::base_parameters::JointResidual;
use super::base_parameters::rows::{RowSampler, RowSettings, friction_voltage};
use recordings::StepError;
use recordings::campaign::Trace;
use recordings::motion::Motion;
use signal::rms;

/// Commands of all joints over an unbroken stretch of a log, recorded and reconstructed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reconstruction {
    /// Instants [s].
    pub time_s: Vec<f64>,
    /// The joints in order.
    pub joints: Vec<JointReconstruction>,
}

/// One joint's commands.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct JointReconstruction {
    /// Recorded command [V].
    pub measured_v: Vec<f64>,
    /// What rigid body and friction need for the motion [V].
    pub reconstructed_v: Vec<f64>,
    /// Friction's part of it [V], Fig. 8.
    pub friction_v: Vec<f64>,
    /// Root mean squares.
    pub residual: JointResidual,
}

/// Reconstructs the command from the measured motion by inverse dynamics and LuGre friction.
///
/// Both commands have gone through the same filter; within its memory of the stretch's
/// ends there are no instants.
///
/// # Errors
/// A log that lacks a joint or is nowhere unbroken for a second.
pub fn reconstruct(
    trace: &Trace,
    robot: &Robot<f64>,
    settings: &RowSettings,
) -> Result<Vec<Reconstruction>, StepError> {
    let stretches = Motion::stretches(trace, settings.motion_cutoff_hz, settings.instant)?;
    Ok(stretches.iter().map(|motion| of_motion(motion, robot, settings)).collect())
}

fn of_motion(motion: &Motion, robot: &Robot<f64>, settings: &RowSettings) -> Reconstruction {
    let sampler = RowSampler::new(settings, motion.period_s);
    let rigid_v = rigid_body_voltage(motion, robot);
    let joint = |index: usize| {
        let velocity = &motion.qd_rad_per_s[index];
        let friction_v = friction_voltage(&robot.friction[index], velocity, motion.period_s);
        let whole: Vec<f64> = rigid_v
            .iter()
            .zip(&friction_v)
            .map(|(rigid, friction)| rigid[index] + friction)
            .collect();
        let measured_v = sampler.take(&motion.command_v[index]);
        let reconstructed_v = sampler.take(&whole);
        let residual = residual(index as u8 + 1, &measured_v, &reconstructed_v);
        JointReconstruction {
            measured_v,
            reconstructed_v,
            friction_v: sampler.take(&friction_v),
            residual,
        }
    };
    Reconstruction { time_s: sampler.times(motion), joints: (0..3).map(joint).collect() }
}

/// What the rigid body needs, eq. (5) [V].
fn rigid_body_voltage(motion: &Motion, robot: &Robot<f64>) -> Vec<[f64; 3]> {
    let at = |k: usize| {
        let (q, qd, qdd) = motion.state(k);
        let posture = Posture::new(q[1], q[2]);
        let torque = posture.inverse_dynamics(&robot.base, &robot.geometry, &qd, &qdd);
        robot.torque_to_voltage(&torque)
    };
    (0..motion.len()).map(at).collect()
}

fn residual(joint: u8, measured_v: &[f64], reconstructed_v: &[f64]) -> JointResidual {
    let left: Vec<f64> = measured_v.iter().zip(reconstructed_v).map(|(a, b)| a - b).collect();
    JointResidual::new(joint, rms(&left), rms(measured_v))
}
