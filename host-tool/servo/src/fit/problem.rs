//! What is fitted to what.

use super::unknown::Unknown;
use crate::judged::Judged;

/// What is fitted to what.
#[derive(Clone, Copy, Debug)]
pub struct Problem<'a> {
    /// The joint, from 0.
    pub joint: usize,
    /// What is not known of it.
    pub unknowns: &'a [Unknown],
    /// The logs.
    pub logs: &'a [&'a Judged],
    /// Longest step of the simulation [s].
    pub step_s: f64,
    /// Rows that say as much as one independent one.
    pub rows_in_one: f64,
    /// Least rms that counts as misfit [rad]: the encoder's.
    pub floor_rad: f64,
    /// Mean square of a block from which on it weighs less [rad^2].
    pub scale: f64,
    /// Most iterations.
    pub iterations: usize,
}
