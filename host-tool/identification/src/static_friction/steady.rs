//! The parts of a log in which a joint moves at a steady velocity.

use model::Friction;
use serde::Serialize;

use crate::one_joint::grey_box::Fit;
use crate::one_joint::parameters::LINEAR;
use crate::one_joint::rows::Rows;

/// A part of a log at steady velocity.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SteadyLeg {
    /// When it begins and ends [s].
    pub time_s: [f64; 2],
    /// Where it begins and ends [rad].
    pub q_rad: [f64; 2],
    /// Mean velocity [rad/s].
    pub velocity_rad_per_s: f64,
    /// Mean command less inertia, gravity and the neighbours' reaction [V].
    #[serde(rename = "friction_V")]
    pub friction_v: f64,
}

/// The steady legs of a log, and the mean friction in each.
///
/// Steady is a stretch of a quarter second and more over which the velocity stays
/// within 3 % of its mean, past the travel in which the bristles settle.
pub fn legs(rows: &Rows, fit: &Fit, friction: &Friction<f64>) -> Vec<SteadyLeg> {
    let row_s = rows.data.step_s * rows.data.points_per_row as f64;
    let window = (0.25 / row_s).ceil().max(2.0) as usize;
    let breakaway_v = friction.alpha0_v.max(friction.alpha0_v + friction.alpha1_v);
    let settling_rad = 3.0 * breakaway_v / friction.sigma0_v_per_rad;
    let (mut legs, mut begin) = (Vec::new(), 0);
    while begin + window <= rows.motion.len() {
        let end = steady_until(rows, begin, window);
        if end == begin {
            begin += window / 4 + 1;
            continue;
        }
        let from = settled_from(rows, begin, end, settling_rad, row_s);
        if from + window / 2 <= end {
            legs.push(leg(rows, fit, from, end));
        }
        begin = end;
    }
    legs
}

/// The end of the steady stretch that begins at a row; the same row where none does.
fn steady_until(rows: &Rows, begin: usize, window: usize) -> usize {
    const SHARE: f64 = 0.03;
    const FLOOR_RAD_PER_S: f64 = 2e-4;
    let velocity = |row: usize| rows.motion[row].qd_rad_per_s;
    let mean = (begin..begin + window).map(velocity).sum::<f64>() / window as f64;
    let band = (SHARE * mean.abs()).max(FLOOR_RAD_PER_S);
    if mean.abs() < 5.0 * FLOOR_RAD_PER_S {
        return begin;
    }
    let steady = |row: usize| (velocity(row) - mean).abs() < band && rows.data.weight[row] > 0.0;
    if !(begin..begin + window).all(steady) {
        return begin;
    }
    (begin..rows.motion.len()).find(|&row| !steady(row)).unwrap_or(rows.motion.len())
}

/// The first row of a stretch by which the joint has travelled far enough since it last
/// stood or turned.
fn settled_from(rows: &Rows, begin: usize, end: usize, travel_rad: f64, row_s: f64) -> usize {
    let sign = rows.motion[begin].qd_rad_per_s.signum();
    let turned = (0..begin).rev().find(|&row| rows.motion[row].qd_rad_per_s * sign <= 0.0);
    let mut travelled = 0.0;
    for row in turned.map_or(0, |row| row + 1)..end {
        travelled += rows.motion[row].qd_rad_per_s.abs() * row_s;
        if travelled > travel_rad {
            return row.max(begin);
        }
    }
    end
}

fn leg(rows: &Rows, fit: &Fit, begin: usize, end: usize) -> SteadyLeg {
    let count = (end - begin) as f64;
    let linear = |row: usize| -> f64 {
        (0..rows.terms.len())
            .map(|column| rows.data.columns[(row, column)] * fit.parameters[LINEAR + column])
            .sum()
    };
    let friction: f64 = (begin..end).map(|row| rows.data.command_v[row] - linear(row)).sum();
    let velocity: f64 = (begin..end).map(|row| rows.motion[row].qd_rad_per_s).sum();
    let (first, last) = (rows.motion[begin], rows.motion[end - 1]);
    SteadyLeg {
        time_s: [first.time_s, last.time_s],
        q_rad: [first.q_rad, last.q_rad],
        velocity_rad_per_s: velocity / count,
        friction_v: friction / count,
    }
}
