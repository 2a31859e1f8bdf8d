//! Fits an effect of the whole arm.
//!
//! Its parameters are fitted with everything of every joint, but gravity's scale, which stays one: a
//! scale and a payload are one thing under two names where a joint is alone.

use rayon::prelude::*;

use model::chain::SerialChain;
use nalgebra::{DMatrix, DVector};

use crate::base::{Base, Frame};
use crate::fit::{Field, Problem, Unknown, errors, fit};
use crate::joint::ServoJoint;
use crate::judged::Judged;
use crate::whole_effect::Whole;
use crate::whole_normal::{STEP_PART, normal};

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

/// The unknowns of a joint with gravity's scale as it should be.
fn rigid(base: &Base) -> Vec<Unknown> {
    base.unknowns.iter().filter(|unknown| unknown.field != Field::Gravity).copied().collect()
}

/// The joints alone fitted to the frame's logs, gravity's scale one.
pub fn fit_plain(frame: &Frame, links: &SerialChain<f64>, bases: &[Base]) -> WholeFit {
    let begin = |base: &Base| ServoJoint { gravity: 1.0, ..base.fitted.servo };
    let servos: Vec<ServoJoint> = bases.iter().map(begin).collect();
    let servos = refitted(frame, bases, frame.logs, &servos, 8);
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
    let mut best: Option<WholeFit> = None;
    let apply = |values: &[f64]| applied(effect, links, frame.logs, values);
    let mut logs = apply(&found.values);
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
        let of = |fit: &WholeFit| fit.left.iter().sum::<f64>();
        // Neither a step that leaves more nor one that leaves no number is kept.
        if best.as_ref().is_none_or(|best| of(best).is_nan() || of(&found) < of(best)) {
            best = Some(found.clone());
        }
        let is_small = !effect.is_beyond(&found.values, links, frame.settings);
        if is_small || step.takes < LEAST_STEP * found.left.iter().sum::<f64>() {
            break;
        }
    }
    best.unwrap_or(found)
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
        let unknowns = rigid(base);
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

/// A step of an effect's values.
struct Step {
    moved: Vec<f64>,
    deviations: Vec<f64>,
    /// What it takes, were everything linear, in squares of one row.
    takes: f64,
}

/// A step of the effect's values, the joints' own unknowns moving along.
#[allow(clippy::too_many_arguments)]
fn step_of(
    frame: &Frame,
    bases: &[Base],
    servos: &[ServoJoint],
    logs: &[&Judged],
    apply: &dyn Fn(&[f64]) -> Vec<Judged>,
    values: &[f64],
    prior: &[f64],
    doubts: &[f64],
) -> Option<Step> {
    let p = values.len();
    let moved: Vec<Vec<Judged>> = (0..p)
        .map(|k| {
            let mut other = values.to_vec();
            other[k] += STEP_PART * doubts[k];
            apply(&other)
        })
        .collect();
    let (mut matrix, mut right) = (DMatrix::zeros(p, p), DVector::zeros(p));
    for k in 0..p {
        matrix[(k, k)] += doubts[k].powi(-2);
        right[k] += (prior[k] - values[k]) / doubts[k].powi(2);
    }
    for (joint, base) in bases.iter().enumerate() {
        let unknowns = rigid(base);
        let problem = Frame { logs, ..*frame }.problem(joint, &unknowns, base.scale);
        let (full, side) = normal(&problem, &servos[joint], &moved, doubts, base);
        let own = unknowns.len();
        let factor = full.view((0, 0), (own, own)).clone_owned().cholesky()?;
        let across = full.view((0, own), (own, p)).clone_owned();
        let rest = side.rows(0, own).clone_owned();
        matrix += full.view((own, own), (p, p)) - across.transpose() * factor.solve(&across);
        right += side.rows(own, p) - across.transpose() * factor.solve(&rest);
    }
    let inverse = matrix.try_inverse()?;
    let found = &inverse * &right;
    let deviations = (0..p).map(|k| inverse[(k, k)].max(0.0).sqrt()).collect();
    let takes = found.dot(&right);
    Some(Step { moved: found.iter().copied().collect(), deviations, takes })
}
