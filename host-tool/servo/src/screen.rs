//! What an effect could take at most of what a joint leaves, were it linear: a cheap first look.
//!
//! What a joint leaves is explained by the slopes of the joint's own unknowns, and by what the effect
//! changes at its starts and at the slopes there, all in one linear fit. It costs a simulation for each of
//! these, where a search takes fifty.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::candidates::Candidate;
use crate::fit::{Field, Problem, Unknown, block_squares, errors};
use crate::joint::ServoJoint;
use crate::judged::Judged;

/// Rows of all logs that count, weighted by the root of their block's weight.
type Column = Vec<f64>;

/// What a joint leaves, and its own slopes.
pub struct Screen<'a> {
    problem: &'a Problem<'a>,
    servo: ServoJoint,
    errors: Column,
    weights: Column,
    own: Vec<(Field, Column)>,
}

impl<'a> Screen<'a> {
    /// Of a joint as it is fitted.
    pub fn of(problem: &'a Problem<'a>, servo: &ServoJoint) -> Self {
        let (errors, weights) = (column(problem, servo), weights(problem, servo));
        let mut found = Self { problem, servo: *servo, errors, weights, own: Vec::new() };
        let slope = |own: &Unknown| (own.field, found.change(&beside(servo, own)));
        found.own = problem.unknowns.par_iter().map(slope).collect();
        found
    }

    /// What goes when the joint is another, weighted.
    fn change(&self, other: &ServoJoint) -> Column {
        let there = column(self.problem, other);
        let pairs = self.errors.iter().zip(there).zip(&self.weights);
        pairs.map(|((here, there), weight)| weight * (here - there)).collect()
    }

    /// An effect with the start from which it takes most, where that is at least a part of the squares.
    pub fn promising(&self, effect: &Candidate, least: f64) -> Option<Candidate> {
        let starts = effect.starts.iter().map(|values| (self.at(effect, values), values));
        let (part, best) = starts.max_by(|a, b| a.0.total_cmp(&b.0))?;
        let starts = vec![best.clone()];
        (part >= least).then(|| Candidate { starts, ..effect.clone() })
    }

    fn at(&self, effect: &Candidate, values: &[f64]) -> f64 {
        let start = effect.start(&self.servo, values);
        let first = self.change(&start);
        let slope = |unknown: &Unknown| -> Column {
            let moved = self.change(&beside(&start, unknown));
            moved.iter().zip(&first).map(|(moved, first)| moved - first).collect()
        };
        let mut columns: Vec<Column> = effect.unknowns.iter().map(slope).collect();
        columns.push(first);
        // What an effect goes on with beyond its bound, the row's own timing, takes nothing more within it.
        let goes_on = |field: Field| effect.unknowns.iter().any(|with| with.field.overlaps(field));
        let own = self.own.iter().filter(|(field, _)| !goes_on(*field));
        let own: Vec<&Column> = own.map(|(_, column)| column).collect();
        let all: Vec<&Column> = own.iter().copied().chain(&columns).collect();
        let left = self.left();
        let total: f64 = left.iter().map(|e| e * e).sum();
        (taken(&left, &all) - taken(&left, &own)) / total.max(f64::MIN_POSITIVE)
    }

    fn left(&self) -> Column {
        self.errors.iter().zip(&self.weights).map(|(error, weight)| weight * error).collect()
    }
}

/// Squares that columns take together, each scaled to one.
fn taken(left: &Column, columns: &[&Column]) -> f64 {
    const RIDGE: f64 = 1e-6;
    let dot = |a: &Column, b: &Column| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let sizes: Vec<f64> = columns.iter().map(|c| dot(c, c).sqrt()).collect();
    let kept: Vec<usize> = (0..columns.len()).filter(|k| sizes[*k] > 0.0).collect();
    let product = |i: usize, k: usize| {
        let (i, k) = (kept[i], kept[k]);
        dot(columns[i], columns[k]) / (sizes[i] * sizes[k])
    };
    let mut matrix = DMatrix::from_fn(kept.len(), kept.len(), product);
    (0..kept.len()).for_each(|k| matrix[(k, k)] += RIDGE);
    let side = |k: usize, _| dot(columns[kept[k]], left) / sizes[kept[k]];
    let right = DVector::from_fn(kept.len(), side);
    matrix.cholesky().map_or(0.0, |factor| factor.solve(&right).dot(&right))
}

/// A joint one step of an unknown beside, within its range.
fn beside(servo: &ServoJoint, unknown: &Unknown) -> ServoJoint {
    let mut other = *servo;
    let here = unknown.coordinate(servo);
    let up = here + unknown.step <= unknown.top();
    unknown.put(&mut other, here + if up { unknown.step } else { -unknown.step });
    other
}

/// Errors of a joint at the rows that count, of all logs.
fn column(problem: &Problem, servo: &ServoJoint) -> Column {
    let joint = problem.joint;
    let of = |log: &&Judged| {
        let left = errors(servo, log, joint, problem.step_s);
        let rows = log.blocks.iter().flat_map(Clone::clone);
        rows.filter(|row| log.counts[joint][*row]).map(|row| left[row]).collect::<Column>()
    };
    problem.logs.iter().flat_map(of).collect()
}

/// The roots of those rows' weights.
fn weights(problem: &Problem, servo: &ServoJoint) -> Column {
    let joint = problem.joint;
    let of = |log: &&Judged| {
        let left = errors(servo, log, joint, problem.step_s);
        let means = block_squares(&left, log, joint);
        let weight = |mean: f64| (1.0 + mean / problem.scale).recip().sqrt();
        means.into_iter().flat_map(|(mean, rows)| vec![weight(mean); rows]).collect::<Column>()
    };
    problem.logs.iter().flat_map(of).collect()
}
