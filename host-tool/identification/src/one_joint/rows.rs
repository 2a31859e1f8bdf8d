//! A log of one joint as rows of the fit.

use nalgebra::{DMatrix, DVector};

use super::grey_box::Data;
use super::motion::{Motion, Smoothing, smoothed};
use super::reconstruction::{Belief, reconstructed};
use super::start;
use model::HANGING_RAD;
use recordings::StepError;
use recordings::campaign::{JointTrace, Known, Trace};

/// Points of the motion that are averaged to a row.
const POINTS_PER_ROW: usize = 5;
/// Samples of the log that are averaged to a point.
const SAMPLES_PER_POINT: usize = 2;
/// Length of a block for the standard errors: a good part of a leg [s].
const BLOCK_S: f64 = 1.5;
/// Velocity noise that smoothing may leave: a twentieth of the usual Stribeck velocity [rad/s].
const VELOCITY_NOISE_RAD_PER_S: f64 = 1.5e-4;

/// A linear term of the command besides friction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Term {
    /// The joint's own inertia: acceleration.
    Inertia,
    /// Gravity: cosine of the moving arm's angle against the level.
    GravityCosine,
    /// Gravity: sine of that angle.
    GravitySine,
    /// A neighbour's acceleration, which the mass matrix couples in.
    Neighbour(u8),
    /// The same times the cosine of the third joint's angle, which is in D23.
    NeighbourCosine(u8),
    /// How the held third joint gives way, times how far that shifts gravity on the second.
    GiveWay,
}

/// Mean motion over a row.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RowMotion {
    /// Time of its middle [s].
    pub time_s: f64,
    /// Angle [rad].
    pub q_rad: f64,
    /// Velocity [rad/s].
    pub qd_rad_per_s: f64,
    /// Acceleration [rad/s^2].
    pub qdd_rad_per_s2: f64,
}

/// The rows of a log and what their columns mean.
#[derive(Clone, Debug)]
pub struct Rows {
    /// What the fit works on.
    pub data: Data,
    /// The linear terms, a column each.
    pub terms: Vec<Term>,
    /// Mean motion of the rows.
    pub motion: Vec<RowMotion>,
}

impl Rows {
    /// Smooths a log and lays it out in rows.
    ///
    /// # Errors
    /// The joint is not in the log, stands still, or the log is too short.
    pub fn of(trace: &Trace, joint: u8, known: &Known) -> Result<Self, StepError> {
        let moving = joint_of(trace, joint)?;
        let how = Smoothing::for_encoder(
            known.encoder_step_rad,
            trace.period_s,
            VELOCITY_NOISE_RAD_PER_S,
        );
        let of = |joint: &JointTrace| smoothed(&trace.time_s, &joint.q_rad, &joint.command_v, &how);
        let motion = of(moving);
        check(trace, joint, &motion, known)?;
        let neighbours: Vec<(u8, Motion)> = trace
            .joints
            .iter()
            .filter(|other| other.number != joint)
            .map(|other| (other.number, of(other)))
            .collect();
        let terms = terms(joint, &neighbours, known);
        let rough = Self::laid_out(&motion, &neighbours, terms.clone(), joint);
        let Some(sliding) = start::sliding(&rough) else { return Ok(rough) };
        let belief = belief(sliding.factors[0], known);
        let (q, u) = (&moving.q_rad, &moving.command_v);
        let motion = reconstructed(&trace.time_s, q, u, &belief, SAMPLES_PER_POINT);
        let neighbours: Vec<(u8, Motion)> =
            neighbours.iter().map(|(n, other)| (*n, other.at_times_of(&motion))).collect();
        Ok(Self::laid_out(&motion, &neighbours, terms, joint))
    }

    fn laid_out(motion: &Motion, neighbours: &[(u8, Motion)], terms: Vec<Term>, joint: u8) -> Self {
        let count = motion.len() / POINTS_PER_ROW;
        let mean = |values: &[f64], row: usize| -> f64 {
            let points = &values[row * POINTS_PER_ROW..(row + 1) * POINTS_PER_ROW];
            points.iter().sum::<f64>() / POINTS_PER_ROW as f64
        };
        let rows: Vec<RowMotion> = (0..count)
            .map(|row| RowMotion {
                time_s: mean(&motion.time_s, row),
                q_rad: mean(&motion.q_rad, row),
                qd_rad_per_s: mean(&motion.qd_rad_per_s, row),
                qdd_rad_per_s2: mean(&motion.qdd_rad_per_s2, row),
            })
            .collect();
        let of = |number: u8| neighbours.iter().find(|(n, _)| *n == number).map(|(_, m)| m);
        let held_rad = of(3).map_or(0.0, |m| m.q_rad.iter().sum::<f64>() / m.len().max(1) as f64);
        let columns = DMatrix::from_fn(count, terms.len(), |row, column| {
            // Joint 3's gravity turns with joint 2, which gives way a little.
            let carried = match joint {
                3 => of(2).map_or(HANGING_RAD[1], |m| mean(&m.q_rad, row)),
                _ => 0.0,
            };
            let angle = rows[row].q_rad + carried;
            match terms[column] {
                Term::Inertia => rows[row].qdd_rad_per_s2,
                Term::GravityCosine => angle.cos(),
                Term::GravitySine => angle.sin(),
                Term::Neighbour(n) => of(n).map_or(0.0, |m| mean(&m.qdd_rad_per_s2, row)),
                Term::NeighbourCosine(n) => {
                    rows[row].q_rad.cos() * of(n).map_or(0.0, |m| mean(&m.qdd_rad_per_s2, row))
                }
                Term::GiveWay => {
                    -angle.sin() * of(3).map_or(0.0, |m| mean(&m.q_rad, row) - held_rad)
                }
            }
        });
        let weight = (0..count).map(|row| {
            let points = &motion.measured[row * POINTS_PER_ROW..(row + 1) * POINTS_PER_ROW];
            f64::from(u8::from(points.iter().all(|&measured| measured)))
        });
        let row_s = motion.step_s * POINTS_PER_ROW as f64;
        let data = Data {
            step_s: motion.step_s,
            qd_rad_per_s: motion.qd_rad_per_s.clone(),
            row_velocity_rad_per_s: rows.iter().map(|row| row.qd_rad_per_s).collect(),
            points_per_row: POINTS_PER_ROW,
            command_v: DVector::from_fn(count, |row, _| mean(&motion.command_v, row)),
            columns,
            weight: weight.collect(),
            rows_per_block: (BLOCK_S / row_s).round().max(1.0) as usize,
        };
        Self { data, terms, motion: rows }
    }

    /// Which column holds a term.
    pub fn column(&self, term: Term) -> Option<usize> {
        self.terms.iter().position(|&t| t == term)
    }
}

fn joint_of(trace: &Trace, joint: u8) -> Result<&JointTrace, StepError> {
    trace.joint(joint).ok_or_else(|| StepError::Unusable {
        file: trace.file.clone(),
        what: format!("joint {joint} is not in the log; name the joint that moved in dataset.toml"),
    })
}

/// The terms that a joint's command has: gravity where its arm is lifted, neighbours
/// where they move by more than a few encoder steps.
fn terms(joint: u8, neighbours: &[(u8, Motion)], known: &Known) -> Vec<Term> {
    const STEPS: f64 = 10.0;
    let mut terms = vec![Term::Inertia];
    if joint != 1 {
        terms.extend([Term::GravityCosine, Term::GravitySine]);
    }
    for (number, motion) in neighbours {
        let range = |f: fn(f64, f64) -> f64, from| motion.q_rad.iter().copied().fold(from, f);
        let span_rad = range(f64::max, f64::MIN) - range(f64::min, f64::MAX);
        if span_rad > STEPS * known.encoder_step_rad {
            terms.push(Term::Neighbour(*number));
            if joint == 3 && *number == 2 {
                terms.push(Term::NeighbourCosine(2));
            }
            if joint == 2 && *number == 3 {
                terms.push(Term::GiveWay);
            }
        }
    }
    terms
}

/// What the reconstruction of the motion is told. The wandering covers what friction
/// does: bristles of some 200 V/rad at any speed up to their steady value.
fn belief(inertia: f64, known: &Known) -> Belief {
    let step_rad = known.encoder_step_rad;
    Belief {
        inertia: inertia.max(1e-6),
        measurement_rad2: step_rad * step_rad / 12.0,
        stiffness_v_per_rad: 200.0,
        wander_v: [5e-4, 1e-2],
    }
}

fn check(trace: &Trace, joint: u8, motion: &Motion, known: &Known) -> Result<(), StepError> {
    const SHORTEST_POINTS: usize = 500;
    let unusable = |what: String| StepError::Unusable { file: trace.file.clone(), what };
    if motion.len() < SHORTEST_POINTS {
        let have_s = motion.len() as f64 * motion.step_s;
        return Err(unusable(format!(
            "{have_s:.2} s are too short for friction; record legs of a second and more"
        )));
    }
    let range = |f: fn(f64, f64) -> f64, from| motion.q_rad.iter().copied().fold(from, f);
    let span_rad = range(f64::max, f64::MIN) - range(f64::min, f64::MAX);
    if span_rad <= 20.0 * known.encoder_step_rad {
        return Err(unusable(format!(
            "joint {joint} never moved (its encoder saw {span_rad:.1e} rad): check that the \
             encoder counts and that `joint` in dataset.toml is the one that was driven"
        )));
    }
    Ok(())
}
