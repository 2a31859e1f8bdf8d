//! What is refitted before any effect: rotor, friction, gravity's scale and timing of each joint.

use std::ops::Range;

use rayon::prelude::*;

use crate::fit::{Field, Fitted, Problem, Unknown, block_squares, errors, fit};
use crate::joint::ServoJoint;
use crate::judged::Judged;
use crate::settings::Settings;

/// The unknowns of a joint, likely where it is given. `period_s` bounds the time between a row's
/// goal and its position.
pub fn unknowns(given: &ServoJoint, period_s: f64, settings: &Settings) -> Vec<Unknown> {
    let doubt = settings.drive_doubt;
    let positive = |field: Field, likely: f64| Unknown::positive(field, likely.max(1e-4), doubt);
    let timing = (0.0, period_s.max(1e-3));
    vec![
        positive(Field::Rotor, given.rotor),
        positive(Field::Viscous, given.viscous),
        positive(Field::Coulomb, given.coulomb),
        Unknown::between(Field::Gravity, [0.0, 3.0], (1.0, settings.gravity_doubt), 0.02),
        // Before its goal acts where the model has a delay.
        Unknown::between(
            Field::ReadAfter,
            [given.read_after_s.min(0.0), period_s],
            timing,
            0.1 * period_s,
        ),
    ]
}

/// What all joints' problems have in common.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a> {
    /// The logs that are fitted to.
    pub logs: &'a [&'a Judged],
    /// Distance of rows [s].
    pub period_s: f64,
    /// The choices.
    pub settings: &'a Settings,
}

impl<'a> Frame<'a> {
    /// A joint's problem, from 0; `scale` as of [`Problem::scale`].
    pub fn problem(&self, joint: usize, unknowns: &'a [Unknown], scale: f64) -> Problem<'a> {
        let settings = self.settings;
        Problem {
            joint,
            unknowns,
            logs: self.logs,
            step_s: settings.search_step_s,
            rows_in_one: (settings.correlation_s / self.period_s).max(1.0),
            floor_rad: FLOOR_RAD,
            scale,
            iterations: 12,
        }
    }

    /// The mean square from which on blocks weigh less: by the median of what a joint leaves of
    /// blocks in which it moves.
    pub fn scale(&self, servo: &ServoJoint, joint: usize) -> f64 {
        let step = self.settings.search_step_s;
        let of = |log: &&Judged| {
            let means = block_squares(&errors(servo, log, joint, step), log, joint);
            let blocks = log.blocks.iter().zip(means).filter(|(_, mean)| mean.1 > 0);
            let with_range = |(rows, mean): (&Range<usize>, (f64, usize))| {
                (range(&log.record.joints[joint].position[rows.clone()]), mean.0)
            };
            blocks.map(with_range).collect()
        };
        let blocks: Vec<Vec<(f64, f64)>> = self.logs.par_iter().map(of).collect();
        let blocks: Vec<(f64, f64)> = blocks.into_iter().flatten().collect();
        let widest = blocks.iter().map(|block| block.0).fold(0.0, f64::max);
        let moving = blocks.iter().filter(|block| block.0 >= MOVING_PART * widest);
        let mut means: Vec<f64> = moving.map(|block| block.1).collect();
        means.sort_by(f64::total_cmp);
        let median = means.get(means.len() / 2).copied().unwrap_or(0.0);
        self.settings.outlying_rms.powi(2) * median.max(FLOOR_RAD.powi(2))
    }
}

/// A joint moves in a block in which it goes this part of its widest block.
const MOVING_PART: f64 = 0.1;

fn range(values: &[f64]) -> f64 {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    high - low
}

/// Errors below this are the encoder's [rad]: a step of 12 bits, uniformly rounded.
pub const FLOOR_RAD: f64 = 4.4e-4;

/// A joint before effects.
#[derive(Clone, Debug)]
pub struct Base {
    /// As the file gives it.
    pub given: ServoJoint,
    /// What is refitted.
    pub unknowns: Vec<Unknown>,
    /// Mean square of a block from which on it weighs less [rad^2].
    pub scale: f64,
    /// Refitted.
    pub fitted: Fitted,
}

impl Base {
    /// The joint as given, with what is refitted of it as it is in another.
    pub fn with_values_of(&self, servo: &ServoJoint) -> ServoJoint {
        let mut found = self.given;
        self.unknowns
            .iter()
            .for_each(|unknown| unknown.field.set(&mut found, unknown.field.of(servo)));
        found
    }

    /// The unknowns with gravity's scale as it should be.
    pub fn rigid_unknowns(&self) -> Vec<Unknown> {
        self.unknowns.iter().filter(|unknown| unknown.field != Field::Gravity).copied().collect()
    }
}

/// All joints refitted to the logs; weights of blocks by what the first fit leaves.
pub fn refit(
    frame: &Frame,
    given: &[ServoJoint],
    starts: &[ServoJoint],
    is_first: bool,
) -> Vec<Base> {
    let joints: Vec<usize> = (0..given.len()).collect();
    let of = |joint: &usize| {
        let joint = *joint;
        let unknowns = unknowns(&given[joint], frame.period_s, frame.settings);
        let mut start = starts[joint];
        if is_first {
            // A model as given is far off everywhere, and its median large.
            let scale = frame.scale(&start, joint) * 0.2;
            start = fit(&frame.problem(joint, &unknowns, scale), &start).servo;
        }
        let scale = frame.scale(&start, joint);
        let fitted = fit(&frame.problem(joint, &unknowns, scale), &start);
        Base { given: given[joint], unknowns, scale, fitted }
    };
    joints.par_iter().map(of).collect()
}
