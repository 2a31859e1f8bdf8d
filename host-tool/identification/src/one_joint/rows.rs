//! The rows of a fit on one joint: mean motion, command and linear terms.

use nalgebra::{DMatrix, DVector};

use super::grey_box::Data;
use model::HANGING_RAD;
use recordings::smoothed::SmoothedMotion;

/// Points of the motion that are averaged to a row.
const POINTS_PER_ROW: usize = 5;
/// Length of a block for the standard errors: a good part of a leg [s].
const BLOCK_S: f64 = 1.5;

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
    /// Deflection of the third joint, which is held, times how that shifts gravity on the
    /// second.
    Compliance,
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
    /// The data of the fit.
    pub data: Data,
    /// The linear terms, a column each.
    pub terms: Vec<Term>,
    /// Mean motion of the rows.
    pub motion: Vec<RowMotion>,
}

impl Rows {
    /// Rows of a motion, with the neighbours' at the same times.
    pub fn of_motion(
        motion: &SmoothedMotion,
        neighbours: &[(u8, SmoothedMotion)],
        terms: Vec<Term>,
        joint: u8,
    ) -> Self {
        let rows = row_motions(motion);
        let count = rows.len();
        let columns = columns(&rows, neighbours, &terms, joint);
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

/// Mean of a row's points.
fn mean(values: &[f64], row: usize) -> f64 {
    let points = &values[row * POINTS_PER_ROW..(row + 1) * POINTS_PER_ROW];
    points.iter().sum::<f64>() / POINTS_PER_ROW as f64
}

fn row_motions(motion: &SmoothedMotion) -> Vec<RowMotion> {
    let at = |row: usize| RowMotion {
        time_s: mean(&motion.time_s, row),
        q_rad: mean(&motion.q_rad, row),
        qd_rad_per_s: mean(&motion.qd_rad_per_s, row),
        qdd_rad_per_s2: mean(&motion.qdd_rad_per_s2, row),
    };
    (0..motion.len() / POINTS_PER_ROW).map(at).collect()
}

/// The regressors of the linear terms, a row of the matrix each.
fn columns(
    rows: &[RowMotion],
    neighbours: &[(u8, SmoothedMotion)],
    terms: &[Term],
    joint: u8,
) -> DMatrix<f64> {
    let of = |number: u8| neighbours.iter().find(|(n, _)| *n == number).map(|(_, m)| m);
    let held_rad = of(3).map_or(0.0, |m| m.q_rad.iter().sum::<f64>() / m.len().max(1) as f64);
    DMatrix::from_fn(rows.len(), terms.len(), |row, column| {
        // Joint 3's gravity turns with joint 2, which gives way a little.
        let parent_rad = match joint {
            3 => of(2).map_or(HANGING_RAD[1], |m| mean(&m.q_rad, row)),
            _ => 0.0,
        };
        let angle = rows[row].q_rad + parent_rad;
        let acceleration = |n: u8| of(n).map_or(0.0, |m| mean(&m.qdd_rad_per_s2, row));
        match terms[column] {
            Term::Inertia => rows[row].qdd_rad_per_s2,
            Term::GravityCosine => angle.cos(),
            Term::GravitySine => angle.sin(),
            Term::Neighbour(n) => acceleration(n),
            Term::NeighbourCosine(n) => rows[row].q_rad.cos() * acceleration(n),
            Term::Compliance => {
                -angle.sin() * of(3).map_or(0.0, |m| mean(&m.q_rad, row) - held_rad)
            }
        }
    })
}
