//! Breakaway levels that no log shows.
//!
//! Friction of another law than eq. (9) may be fitted best by a Stribeck curve, eq. (10), that is
//! narrower than all speeds of the log and goes to hundreds of volts at zero, though a joint that
//! moved broke away at less; or by one that goes to nothing there, where bristles cannot bend.

use super::constants::{BARELY_KNOWN, FINELY};
use crate::one_joint::grey_box::{self, Fit};
use crate::one_joint::parameters::LINEAR;
use crate::one_joint::rows::Rows;

/// Rows are means over 10 ms, in which a peak is passed: it may be so many times as high as they show.
const ABOVE_MEANS: f64 = 2.0;
/// Least breakaway level, in parts of the Coulomb level, so that bristles can bend.
const LEAST: f64 = 0.01;
/// The part of all rows that counts as shown: the largest few may be reversals or spikes.
const SHOWN_PART: f64 = 0.999;
/// Index of the logarithm of the Coulomb level.
const COULOMB: usize = 0;
/// Index of the logarithm of the breakaway level.
const BREAKAWAY: usize = 1;
/// Index of the logarithm of the Stribeck velocity.
const STRIBECK_VELOCITY: usize = 2;

/// The fit, or where its breakaway level is above or below what rows leave open, one with the nearest that is not; `free`
/// are the parameters that may move.
pub(super) fn within_what_rows_show(rows: &Rows, fit: Fit, free: &[usize]) -> Fit {
    let most_v = ABOVE_MEANS * friction_shown_v(rows, &fit);
    let least_v = LEAST * fit.parameters[COULOMB].exp();
    let found_v = fit.parameters[BREAKAWAY].exp();
    let is_open = found_v.is_finite() && least_v < most_v;
    if !is_open || (least_v..=most_v).contains(&found_v) {
        return fit;
    }
    let nearest_v = found_v.clamp(least_v, most_v);
    let mut held = held_at(rows, fit, free, nearest_v);
    // The level lies between the two, and of the curve to it nothing is known.
    held.covariance[(BREAKAWAY, BREAKAWAY)] = (0.5 * most_v / nearest_v).powi(2);
    held.covariance[(STRIBECK_VELOCITY, STRIBECK_VELOCITY)] += 4.0 * BARELY_KNOWN * BARELY_KNOWN;
    held
}

/// The fit with a breakaway level that is held.
fn held_at(rows: &Rows, fit: Fit, free: &[usize], breakaway_v: f64) -> Fit {
    let mut start = fit.parameters;
    start[BREAKAWAY] = breakaway_v.ln();
    let free: Vec<usize> = free.iter().copied().filter(|k| *k != BREAKAWAY).collect();
    grey_box::fit(&rows.data, start, &free, FINELY)
}

/// The friction, but for its viscous part, that nearly all rows stay below [V]; 0 without rows.
fn friction_shown_v(rows: &Rows, fit: &Fit) -> f64 {
    let data = &rows.data;
    let linear = &data.columns * fit.parameters.rows_range(LINEAR..);
    let alpha2 = fit.friction().alpha2_v_s_per_rad;
    let friction_v = |row: usize| {
        let viscous_v = alpha2 * data.row_velocity_rad_per_s[row];
        (data.command_v[row] - linear[row] - viscous_v).abs()
    };
    let counting = (0..data.command_v.len()).filter(|row| data.weight[*row] > 0.0);
    let mut all_v: Vec<f64> = counting.map(friction_v).collect();
    all_v.sort_by(f64::total_cmp);
    all_v.get((SHOWN_PART * all_v.len() as f64) as usize).copied().unwrap_or(0.0)
}
