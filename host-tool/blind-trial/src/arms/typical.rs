//! What an arm does where nothing is hidden, by which effects are sized.

use recordings::ArmCampaign;
use rig::effects::Typical;
use signal::{derivative, rms};

use super::case::{ArmCase, plant};
use crate::error::TrialError;

/// What is typical of a joint (from 1, or 0 for the whole arm) in the logs of a case without effects.
///
/// # Errors
/// A file that describes no arm.
pub fn typical(case: &ArmCase, clean: &ArmCampaign, joint: u8) -> Result<Typical, TrialError> {
    let index = usize::from(joint.max(1)) - 1;
    let plant = plant(&case.truth)?;
    let positions: Vec<f64> =
        clean.recordings.iter().flat_map(|log| log.log.joints[index].position.clone()).collect();
    // A first joint whose axis is vertical carries no gravity.
    let loaded = if joint == 0 { 0..plant.joints() } else { index..index + 1 };
    let command_v = command_v(case, clean, index);
    Ok(Typical {
        command_v,
        motor_nm: command_v * plant.torque_constant_nm_per_v[index],
        friction_v: plant.friction[index].alpha0_v,
        load_nm: loaded.map(|joint| load_nm(&plant, clean, joint)).fold(0.0, f64::max),
        speed_rad_per_s: speed(clean, index),
        position_rad: positions.iter().sum::<f64>() / positions.len().max(1) as f64,
        tip_height_m: tip_height_m(&plant, clean),
        inertia_kg_m2: plant.body.inertia(index, &vec![0.0; case.truth.joints.len()]),
    })
}

/// The largest command; of a servo what its law makes of the largest distance to its goal.
fn command_v(case: &ArmCase, clean: &ArmCampaign, joint: usize) -> f64 {
    let joints = clean.recordings.iter().map(|log| &log.log.joints[joint]);
    let drive = case.truth.joints[joint].drive.as_ref();
    let Some(stiffness) = drive.and_then(|drive| drive.stiffness) else {
        return joints.flat_map(|log| &log.command).fold(0.0, |most, u| most.max(u.abs()));
    };
    let distances = joints.flat_map(|log| log.command.iter().zip(&log.position));
    let most = distances.fold(0.0, |most: f64, (goal, q)| most.max((goal - q).abs()));
    let limit = drive.and_then(|drive| drive.limit).unwrap_or(f64::INFINITY);
    (stiffness * most).min(limit)
}

/// Rows that are looked at: postures change slowly.
const EVERY: usize = 20;

/// Gravity's torque along the logs, rms [Nm; N].
fn load_nm(plant: &rig::Plant, clean: &ArmCampaign, joint: usize) -> f64 {
    /// Less is no load.
    const LEAST: f64 = 1e-3;
    let count = plant.joints();
    let mut loads = Vec::new();
    for log in clean.recordings.iter().map(|recording| &recording.log) {
        for row in (0..log.time_s.len()).step_by(EVERY) {
            let q: Vec<f64> = log.joints.iter().map(|joint| joint.position[row]).collect();
            let mut load = vec![0.0; count];
            plant.body.mechanism().gravity(&q, &mut load);
            loads.push(load[joint]);
        }
    }
    rms(&loads).max(LEAST)
}

/// Lowest and highest place of the tip [m].
fn tip_height_m(plant: &rig::Plant, clean: &ArmCampaign) -> [f64; 2] {
    let mut range = [f64::INFINITY, f64::NEG_INFINITY];
    for log in clean.recordings.iter().map(|recording| &recording.log) {
        for row in (0..log.time_s.len()).step_by(EVERY) {
            let q: Vec<f64> = log.joints.iter().map(|joint| joint.position[row]).collect();
            let height_m = plant.body.tip_height_m(&q);
            range = [range[0].min(height_m), range[1].max(height_m)];
        }
    }
    range
}

/// Twice the largest rms of velocity in a log: about its highest.
fn speed(clean: &ArmCampaign, joint: usize) -> f64 {
    let of_log = |recording: &recordings::ArmRecording| {
        let log = &recording.log;
        let period_s = (log.time_s[log.time_s.len() - 1] - log.time_s[0]) / log.time_s.len() as f64;
        2.0 * rms(&derivative::first(&log.joints[joint].position, period_s))
    };
    clean.recordings.iter().map(of_log).fold(1e-6, f64::max)
}
