//! Whether the model is that of the robot in the logs at all.

use crate::fit::fitted_model::FittedModel;
use crate::logs::intervals::at_samples;
use crate::logs::subject::Subject;
use crate::result::Verdict;

/// What must be said where a refitted model is not that of the robot in the logs.
pub fn remark(subject: &Subject, refitted: &FittedModel, verdict: Verdict) -> Option<String> {
    if verdict == Verdict::Effect {
        return None;
    }
    let parts = subject.joints.iter().map(|&joint| part_left(refitted, joint));
    let (place, part) = parts.enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let cure = "check lengths, the order and signs of joints, encoder_counts_per_rev and \
                torque_constant_Nm_per_V, or identify the model anew";
    if verdict == Verdict::Unknown && part > subject.criteria.verdict.another_robot_part {
        return Some(format!(
            "the logs do not fit this model: refitted, it leaves {:.0} % of the command of joint \
             {}; {cure}",
            100.0 * part,
            subject.numbers[place]
        ));
    }
    if refitted.stats.is_implausible(&subject.criteria.fit) {
        return Some(format!(
            "the logs do not fit this model: refitted, its parameters are further from the file's \
             than two or three per cent of doubt allow; {cure}"
        ));
    }
    let ratio = refitted.stats.worst();
    (verdict == Verdict::Unknown && ratio > subject.criteria.verdict.another_robot_ratio).then(
        || {
            format!(
                "the logs do not fit this model: refitted, it leaves {ratio:.0} times the noise; \
                 {cure}"
            )
        },
    )
}

/// Joints (from 0) of which a refitted model leaves a large part of the command although its parameters
/// are far from the file's, as if the logs were another robot's: causes on them that do not explain all
/// of that are none. Where half of the joints are like this, all count.
pub fn joints_of_another(subject: &Subject, refitted: &FittedModel) -> Vec<usize> {
    if !refitted.stats.is_implausible(&subject.criteria.fit) {
        return Vec::new();
    }
    let such: Vec<usize> = joints_left(subject, refitted).collect();
    if 2 * such.len() >= subject.joints.len() { subject.joints.clone() } else { such }
}

/// Whether a model leaves a large part of a joint's command.
pub fn leaves_much(subject: &Subject, model: &FittedModel) -> bool {
    joints_left(subject, model).next().is_some()
}

/// Joints (from 0) of whose command a model leaves a large part.
fn joints_left(subject: &Subject, model: &FittedModel) -> impl Iterator<Item = usize> {
    let most = subject.criteria.verdict.another_robot_part;
    subject.joints.iter().copied().filter(move |&joint| part_left(model, joint) > most)
}

/// Part of a joint's command that a model leaves, rms by rms over train rows.
fn part_left(model: &FittedModel, joint: usize) -> f64 {
    let evidence = &model.evidence;
    let square = |rows: &[f64]| rows.iter().map(|row| row * row).sum::<f64>();
    let command = |s: usize| at_samples(&evidence.stretches[s].command_v[joint]);
    let whole: f64 = (0..evidence.train_stretches())
        .map(|s| square(&evidence.filter(joint, s).rows(&command(s))))
        .sum();
    if whole > 0.0 { (square(&model.residual_v[joint]) / whole).sqrt() } else { 0.0 }
}
