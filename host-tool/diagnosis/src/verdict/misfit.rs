//! Whether the model is that of the robot in the logs at all.

use crate::fit::linearisation::Linearisation;
use crate::fit::residual_stats::ResidualStats;
use crate::logs::intervals::at_samples;
use crate::logs::subject::Subject;
use crate::result::Verdict;
use crate::rows::evidence::Evidence;

/// What must be said where a refitted model is not that of the robot in the logs.
pub fn remark(
    subject: &Subject,
    evidence: &Evidence,
    refitted: &Linearisation,
    verdict: Verdict,
) -> Option<String> {
    let stats = ResidualStats::of(evidence, refitted);
    if verdict == Verdict::Effect {
        return None;
    }
    let parts = subject.joints.iter().map(|&joint| part_left(evidence, refitted, joint));
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
    stats.is_implausible(&subject.criteria.fit).then(|| {
        format!(
            "the logs do not fit this model: refitted, its parameters are further from the file's \
             than two or three per cent of doubt allow; {cure}"
        )
    })
}

/// Part of a joint's command that a model leaves, rms by rms over all rows.
fn part_left(evidence: &Evidence, linear: &Linearisation, joint: usize) -> f64 {
    let (mut left, mut whole) = (0.0, 0.0);
    for (s, range) in evidence.ranges(joint).into_iter().enumerate() {
        let command = at_samples(&evidence.stretches[s].command_v[joint]);
        let unit = evidence.floor_v(joint, s).powi(2);
        let squares = |rows: &[f64]| unit * rows.iter().map(|row| row * row).sum::<f64>();
        left += squares(&linear.residual[joint][range]);
        whole += squares(&evidence.weighted(s, joint, &command));
    }
    if whole > 0.0 { (left / whole).sqrt() } else { 0.0 }
}
