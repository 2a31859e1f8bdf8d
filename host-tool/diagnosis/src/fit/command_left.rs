//! What a fitted model leaves of the commands.

use super::fitted_model::FittedModel;
use crate::logs::intervals::at_samples;
use crate::logs::subject::Subject;

/// Whether a model leaves a large part of a joint's command.
pub fn leaves_much(subject: &Subject, model: &FittedModel) -> bool {
    joints_left(subject, model).next().is_some()
}

/// Joints (from 0) of whose command a model leaves a large part.
pub fn joints_left(subject: &Subject, model: &FittedModel) -> impl Iterator<Item = usize> {
    let most = subject.criteria.verdict.another_robot_part;
    subject.joints.iter().copied().filter(move |&joint| part_left(model, joint) > most)
}

/// Part of a joint's command that a model leaves, rms by rms over train rows.
pub fn part_left(model: &FittedModel, joint: usize) -> f64 {
    let evidence = &model.evidence;
    let square = |rows: &[f64]| rows.iter().map(|row| row * row).sum::<f64>();
    let command = |s: usize| at_samples(&evidence.stretches[s].command_v[joint]);
    let whole: f64 = (0..evidence.train_stretches())
        .map(|s| square(&evidence.filter(joint, s).rows(&command(s))))
        .sum();
    if whole > 0.0 { (square(&model.residual_v[joint]) / whole).sqrt() } else { 0.0 }
}
