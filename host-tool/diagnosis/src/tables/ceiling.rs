//! The most that anything along an axis could explain.

use rayon::prelude::*;

use super::knots::flat;
use crate::fit::excess::excess_v2;
use crate::fit::fitted_model::FittedModel;
use crate::fit::slopes::table_hats;
use crate::logs::subject::Subject;
use crate::rows::evidence::RowChange;
use crate::search::policy::gain;
use crate::trial::equation::Trial;
use files::Role;
use rig::effects::{Table, TableAxis};

/// A model with one table more.
#[derive(Clone)]
pub struct WithTable {
    /// The table.
    pub table: Table,
    /// The model with it.
    pub model: FittedModel,
    /// Log-likelihood that the model gains by it.
    pub gain: f64,
}

/// Whether an effect (the one at `index` of a model) reaches what a table over an axis of its joint
/// explains, or pays beside that table.
pub fn reaches_ceiling(
    subject: &Subject,
    without: &FittedModel,
    with: &FittedModel,
    index: usize,
) -> bool {
    let policy = &subject.criteria.selection;
    let effect = &with.linear.hypothesis.effects[index];
    let Some(joint) = usize::from(effect.joint).checked_sub(1) else { return true };
    let Some(best) = with_best_table(subject, without, joint) else { return true };
    let (by_effect, by_table) = (
        part_taken(subject, without, with, joint),
        part_taken(subject, without, &best.model, joint),
    );
    if by_effect >= policy.least_of_ceiling * by_table || gain(without, with) >= best.gain {
        return true;
    }
    let mut both = best.model.linear.hypothesis.clone();
    both.effects.insert(index, effect.clone());
    let both = both.with_room(index);
    let steps = policy.table_steps;
    let FittedModel { linear, evidence, .. } = &best.model;
    let both = FittedModel::fitted_near(linear, evidence, subject, both, steps);
    both.is_some_and(|both| {
        gain(&best.model, &both) > policy.least_log_likelihood
            && part_taken(subject, &best.model, &both, joint) > policy.least_beside_table
    })
}

/// Part of what is left above the noise of a joint's left-out train rows that goes.
pub fn part_taken(
    subject: &Subject,
    before: &FittedModel,
    after: &FittedModel,
    joint: usize,
) -> f64 {
    let of = |model: &FittedModel| excess_left_v2(subject, model, joint);
    let from = of(before);
    if from > 0.0 { 1.0 - of(after) / from } else { 0.0 }
}

/// Squares above the noise of a joint's left-out train rows [V^2].
pub fn excess_left_v2(subject: &Subject, model: &FittedModel, joint: usize) -> f64 {
    let place = subject.joints.iter().position(|of| *of == joint).unwrap_or(0);
    excess_v2(&model.evidence, &model.left_out_v, Role::Train)[place]
}

/// A model with the table over that axis of a joint (0 to 2) that promises most; none where no table
/// can be fitted.
pub fn with_best_table(subject: &Subject, before: &FittedModel, joint: usize) -> Option<WithTable> {
    let hypothesis = &before.linear.hypothesis;
    let is_there = |axis: TableAxis| {
        let same = |table: &Table| usize::from(table.joint) == joint + 1 && table.axis == axis;
        hypothesis.tables.iter().any(same)
    };
    let promised = |axis: &TableAxis| {
        let flat = flat(&before.evidence, hypothesis, joint, *axis)?;
        Some((promise(subject, before, &flat, joint)?, flat))
    };
    let open: Vec<TableAxis> = TableAxis::ALL.into_iter().filter(|axis| !is_there(*axis)).collect();
    let tables = open.par_iter().filter_map(promised);
    let (_, table) = tables.max_by(|a, b| a.0.total_cmp(&b.0))?;
    let model = fitted(subject, before, table)?;
    let table = model.linear.hypothesis.tables.last()?.clone();
    Some(WithTable { table, gain: gain(before, &model), model })
}

/// Weighted squares that a table would take away, everything open refitted by the slopes, less one
/// for each of its knots, which chance takes.
fn promise(subject: &Subject, before: &FittedModel, table: &Table, joint: usize) -> Option<f64> {
    let evidence = &before.evidence;
    let mut columns: Vec<RowChange> = vec![evidence.no_change(); table.knots.len()];
    for (s, stretch) in evidence.stretches[..evidence.train_stretches()].iter().enumerate() {
        let trial = Trial::of(stretch, &before.linear.hypothesis, &evidence.criteria.fit);
        let gain = trial.motor_gain(joint);
        for (column, mut hat) in columns.iter_mut().zip(table_hats(&trial, table, joint)) {
            hat.iter_mut().for_each(|value| *value /= gain);
            column[joint].get_or_insert_default().extend(evidence.weighted(s, joint, &hat));
        }
    }
    let (gradient, mut curvature) = before.linear.along(&RowChange::default(), &columns);
    let weight = subject.table_deviations_v[joint].powi(-2);
    (0..columns.len()).for_each(|k| curvature[(k, k)] += weight);
    let values = curvature.lu().solve(&gradient)?;
    Some(gradient.dot(&values) - columns.len() as f64)
}

/// A model with a table more, fitted.
fn fitted(subject: &Subject, before: &FittedModel, table: Table) -> Option<FittedModel> {
    let FittedModel { linear, evidence, .. } = before;
    let mut with = linear.hypothesis.clone();
    with.tables.push(table);
    let steps = subject.criteria.selection.table_steps;
    FittedModel::fitted_near(linear, evidence, subject, with, steps)
}
