//! Breakaway levels that no log shows.
//!
//! Friction of another law than eq. (9) may be fitted best by a Stribeck curve, eq. (10), that is
//! narrower than all speeds of the log and goes to hundreds of volts at zero, though a joint that
//! moved broke away at less; or by one that goes to nothing there, of which bristles cannot bend.

use super::{FINELY, UNSEEN_BREAKAWAY};
use crate::one_joint::grey_box::{self, Fit};
use crate::one_joint::parameters::LINEAR;
use crate::one_joint::rows::Rows;

/// Rows are means over 10 ms, in which a peak is passed: it may be so many times as high as they show.
const ABOVE_MEANS: f64 = 2.0;
/// Least breakaway level, in parts of the Coulomb level: bristles of one whose friction is nothing at rest bend by this.
const LEAST: f64 = 0.01;
/// Index of the logarithm of the Coulomb level.
const COULOMB: usize = 0;
/// Index of the logarithm of the breakaway level.
const BREAKAWAY: usize = 1;

/// The fit, or where its breakaway level is beyond the friction of all rows, or nothing, one with the nearest that is not;
/// `free` are the parameters that may move.
pub(super) fn within_what_rows_show(rows: &Rows, fit: Fit, free: &[usize]) -> Fit {
    let shown_v = largest_friction_v(rows, &fit);
    let least_v = LEAST * fit.parameters[COULOMB].exp();
    let found_v = fit.parameters[BREAKAWAY].exp();
    if found_v > ABOVE_MEANS * shown_v && shown_v > least_v {
        held_at(rows, fit, free, shown_v)
    } else if found_v < least_v {
        held_at(rows, fit, free, least_v)
    } else {
        fit
    }
}

/// The fit with a breakaway level that is held.
fn held_at(rows: &Rows, fit: Fit, free: &[usize], breakaway_v: f64) -> Fit {
    let mut start = fit.parameters;
    start[BREAKAWAY] = breakaway_v.ln();
    let free: Vec<usize> = free.iter().copied().filter(|k| *k != BREAKAWAY).collect();
    let mut held = grey_box::fit(&rows.data, start, &free, FINELY);
    held.covariance[(BREAKAWAY, BREAKAWAY)] = UNSEEN_BREAKAWAY * UNSEEN_BREAKAWAY;
    held
}

/// The largest friction, but for the viscous part, of the rows that count [V].
fn largest_friction_v(rows: &Rows, fit: &Fit) -> f64 {
    let data = &rows.data;
    let linear = &data.columns * fit.parameters.rows_range(LINEAR..);
    let alpha2 = fit.friction().alpha2_v_s_per_rad;
    let friction_v = |row: usize| {
        let viscous_v = alpha2 * data.row_velocity_rad_per_s[row];
        (data.command_v[row] - linear[row] - viscous_v).abs()
    };
    let counting = (0..data.command_v.len()).filter(|row| data.weight[*row] > 0.0);
    counting.map(friction_v).fold(0.0, f64::max)
}
