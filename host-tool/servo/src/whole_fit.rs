//! Fits an effect of the whole arm.
//!
//! Its parameters are fitted with everything of every joint, but gravity's scale, which stays one: a
//! scale and a payload are one thing under two names where a joint is alone.

use rayon::prelude::*;

use model::chain::SerialChain;

use crate::base::{Base, Frame};
use crate::fit::{Problem, errors, fit};
use crate::joint::ServoJoint;
use crate::judged::Judged;
use crate::whole_effect::Whole;
use crate::whole_step::step_of;

/// An effect of the whole arm, fitted.
#[derive(Clone, Debug)]
pub struct WholeFit {
    /// Which.
    pub effect: Whole,
    /// Its values.
    pub values: Vec<f64>,
    /// Their standard deviations.
    pub deviations: Vec<f64>,
    /// The joints, gravity's scale one.
    pub servos: Vec<ServoJoint>,
    /// What is left of the logs: sum over joints of squares in those of one row.
    pub left: Vec<f64>,
}

impl WholeFit {
    /// The one of two that leaves less.
    pub fn better_of(self, other: Self) -> Self {
        let of = |fit: &Self| fit.left.iter().sum::<f64>();
        if of(&self).is_nan() || of(&other) < of(&self) { other } else { self }
    }
}

/// The joints as they are, gravity's scale one.
pub fn rigid(bases: &[Base]) -> Vec<ServoJoint> {
    bases.iter().map(|base| ServoJoint { gravity: 1.0, ..base.fitted.servo }).collect()
}

/// The joints alone fitted to the frame's logs from these, gravity's scale one.
pub fn fit_plain(
    frame: &Frame,
    links: &SerialChain<f64>,
    bases: &[Base],
    servos: &[ServoJoint],
) -> WholeFit {
    let servos = refitted(frame, bases, frame.logs, servos, 8);
    let left = left(frame, bases, &servos, frame.logs);
    let effect = Whole::Payload;
    let values = effect.start(links);
    WholeFit { effect, deviations: vec![0.0; values.len()], values, servos, left }
}

/// Fits an effect to the frame's logs from another fit, of the same effect or of none.
///
/// It ends where a step takes next to nothing, or where the effect is too small to be told from what the
/// links are wrong by.
pub fn fit_whole(
    frame: &Frame,
    links: &SerialChain<f64>,
    bases: &[Base],
    effect: Whole,
    from: &WholeFit,
) -> WholeFit {
    const ROUNDS: usize = 12;
    /// A step that takes a smaller part of what is left is the last one.
    const LEAST_STEP: f64 = 0.003;
    let (prior, doubts) = (effect.start(links), effect.doubts(links, frame.settings));
    let mut found = from.clone();
    if found.effect != effect {
        let deviations = vec![f64::INFINITY; prior.len()];
        found = WholeFit { effect, values: prior.clone(), deviations, ..found };
    }
    let apply = |values: &[f64]| applied(effect, links, frame.logs, values);
    let mut logs = apply(&found.values);
    found.left = left(frame, bases, &found.servos, &logs.iter().collect::<Vec<_>>());
    let mut best = found.clone();
    for _ in 0..ROUNDS {
        let here: Vec<&Judged> = logs.iter().collect();
        let WholeFit { values, servos, .. } = &found;
        let step = step_of(frame, bases, servos, &here, &apply, values, &prior, &doubts);
        let Some(step) = step else { break };
        found.values = effect.moved(&found.values, &step.moved);
        found.deviations = step.deviations;
        logs = apply(&found.values);
        let here: Vec<&Judged> = logs.iter().collect();
        found.servos = refitted(frame, bases, &here, &found.servos, 3);
        found.left = left(frame, bases, &found.servos, &here);
        // Neither a step that leaves more nor one that leaves no number is kept.
        best = best.better_of(found.clone());
        let is_small = !effect.is_beyond(&found.values, links, frame.settings);
        if is_small || step.takes < LEAST_STEP * found.left.iter().sum::<f64>() {
            break;
        }
    }
    best
}

fn applied(kind: Whole, links: &SerialChain<f64>, logs: &[&Judged], values: &[f64]) -> Vec<Judged> {
    logs.par_iter().map(|log| kind.applied(links, log, values)).collect()
}

fn refitted(
    frame: &Frame,
    bases: &[Base],
    logs: &[&Judged],
    servos: &[ServoJoint],
    iterations: usize,
) -> Vec<ServoJoint> {
    let of = |(joint, base): (usize, &Base)| {
        let unknowns = base.rigid_unknowns();
        let frame = Frame { logs, ..*frame };
        let problem = Problem { iterations, ..frame.problem(joint, &unknowns, base.scale) };
        fit(&problem, &servos[joint]).servo
    };
    bases.par_iter().enumerate().map(of).collect()
}

/// What is left of each log, all joints together, in squares of one row.
pub fn left(frame: &Frame, bases: &[Base], servos: &[ServoJoint], logs: &[&Judged]) -> Vec<f64> {
    let step = frame.settings.search_step_s;
    let of = |log: &&Judged| {
        let joints = servos.iter().enumerate();
        let costs = joints.map(|(joint, servo)| {
            let errors = errors(servo, log, joint, step);
            crate::fit::robust(&errors, log, joint, bases[joint].scale)
                / bases[joint].fitted.square_of_one
        });
        costs.sum()
    };
    logs.par_iter().map(of).collect()
}
