//! Whether the model is that of the robot in the logs at all.

use crate::fit::command_left::{joints_left, part_left};
use crate::fit::fitted_model::FittedModel;
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
