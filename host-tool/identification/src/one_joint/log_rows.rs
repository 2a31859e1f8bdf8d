//! A log of one joint as rows of the fit.

use super::reconstruction::{SmootherSettings, reconstructed};
use super::rows::{Rows, Term};
use super::sliding::sliding;
use recordings::StepError;
use recordings::campaign::{JointTrace, Known, Trace};
use recordings::smoothed::{SmoothedMotion, Smoothing, smoothed};

/// Samples of the log that are averaged to a point.
const SAMPLES_PER_POINT: usize = 2;
/// Velocity noise that smoothing may leave: a twentieth of the usual Stribeck velocity [rad/s].
const VELOCITY_NOISE_RAD_PER_S: f64 = 1.5e-4;

/// Smooths a log and lays it out in rows.
///
/// # Errors
/// The joint is not in the log, stands still, or the log is too short.
pub fn log_rows(trace: &Trace, joint: u8, known: &Known) -> Result<Rows, StepError> {
    let moving = joint_of(trace, joint)?;
    let how =
        Smoothing::for_encoder(known.encoder_step_rad, trace.period_s, VELOCITY_NOISE_RAD_PER_S);
    let of = |joint: &JointTrace| smoothed(&trace.time_s, &joint.q_rad, &joint.command_v, &how);
    let motion = of(moving);
    check(trace, joint, &motion, known)?;
    let neighbours: Vec<(u8, SmoothedMotion)> = trace
        .joints
        .iter()
        .filter(|other| other.number != joint)
        .map(|other| (other.number, of(other)))
        .collect();
    let terms = terms(joint, &neighbours, known);
    let rough = Rows::of_motion(&motion, &neighbours, terms.clone(), joint);
    let Some(sliding) = sliding(&rough) else { return Ok(rough) };
    let settings = smoother_settings(sliding.factors[0], known);
    let (q, u) = (&moving.q_rad, &moving.command_v);
    let motion = reconstructed(&trace.time_s, q, u, &settings, SAMPLES_PER_POINT);
    let neighbours: Vec<(u8, SmoothedMotion)> =
        neighbours.iter().map(|(n, other)| (*n, other.at_times_of(&motion))).collect();
    Ok(Rows::of_motion(&motion, &neighbours, terms, joint))
}

fn joint_of(trace: &Trace, joint: u8) -> Result<&JointTrace, StepError> {
    trace.joint(joint).ok_or_else(|| StepError::Unusable {
        file: trace.file.clone(),
        what: format!("joint {joint} is not in the log; name the joint that moved in dataset.toml"),
    })
}

/// The terms that a joint's command has: gravity where its arm is lifted, neighbours
/// where they move by more than a few encoder steps.
fn terms(joint: u8, neighbours: &[(u8, SmoothedMotion)], known: &Known) -> Vec<Term> {
    const STEPS: f64 = 10.0;
    let mut terms = vec![Term::Inertia];
    if joint != 1 {
        terms.extend([Term::GravityCosine, Term::GravitySine]);
    }
    for (number, motion) in neighbours {
        let range = |f: fn(f64, f64) -> f64, from| motion.q_rad.iter().copied().fold(from, f);
        let range_rad = range(f64::max, f64::MIN) - range(f64::min, f64::MAX);
        if range_rad > STEPS * known.encoder_step_rad {
            terms.push(Term::Neighbour(*number));
            if joint == 3 && *number == 2 {
                terms.push(Term::NeighbourCosine(2));
            }
            if joint == 2 && *number == 3 {
                terms.push(Term::Compliance);
            }
        }
    }
    terms
}

/// Settings of the motion's reconstruction. The random walk covers what friction does:
/// bristles of some 200 V/rad at any speed up to their steady value.
fn smoother_settings(inertia: f64, known: &Known) -> SmootherSettings {
    let step_rad = known.encoder_step_rad;
    SmootherSettings {
        inertia: inertia.max(1e-6),
        measurement_rad2: step_rad * step_rad / 12.0,
        stiffness_v_per_rad: 200.0,
        random_walk_v: [5e-4, 1e-2],
    }
}

fn check(
    trace: &Trace,
    joint: u8,
    motion: &SmoothedMotion,
    known: &Known,
) -> Result<(), StepError> {
    const SHORTEST_POINTS: usize = 500;
    let unusable = |what: String| StepError::Unusable { file: trace.file.clone(), what };
    if motion.len() < SHORTEST_POINTS {
        let have_s = motion.len() as f64 * motion.step_s;
        return Err(unusable(format!(
            "{have_s:.2} s are too short for friction; record legs of a second and more"
        )));
    }
    let range = |f: fn(f64, f64) -> f64, from| motion.q_rad.iter().copied().fold(from, f);
    let range_rad = range(f64::max, f64::MIN) - range(f64::min, f64::MAX);
    if range_rad <= 20.0 * known.encoder_step_rad {
        return Err(unusable(format!(
            "joint {joint} never moved (its encoder saw {range_rad:.1e} rad): check that the \
             encoder counts and that `joint` in dataset.toml is the one that was driven"
        )));
    }
    Ok(())
}
