//! Logs whose commands are those of the instants at which rows were read, not of the intervals that begin there.
//!
//! A robot's controller runs faster than its log: of every n commands one is kept, as of the instant of its row. On average
//! it acts (n - 1)/(2 n) of a sample period before what the interval held, half a period at most. Taken as held over the
//! interval, all joints seem to be driven early, by a lag below zero that no drive has.

use super::fitted_model::FittedModel;
use super::preparation::prepared;
use super::unknowns::{Expected, Unknown};
use crate::criteria::LogCriteria;
use crate::logs::stretch::Stretch;
use crate::logs::subject::Subject;
use crate::rows::evidence::Evidence;
use crate::trial::hypothesis::Hypothesis;
use recordings::StepError;

/// The rows, the model refitted to them, and by what part of a sample period commands act before their rows' intervals.
pub type Prepared = (Evidence, FittedModel, f64);

/// Prepares stretches as [`prepared`] does, their commands as of the instants of rows where the refitted model says so, and
/// says so no more then.
///
/// # Errors
/// The logs are too short to see their noise, or do not determine the model.
pub fn prepared_by_instants(
    subject: &Subject,
    stretches: Vec<Stretch>,
    near: Option<&Hypothesis>,
) -> Result<Prepared, StepError> {
    let (evidence, refitted) = prepared(subject, stretches.clone(), near)?;
    let part = early_part(subject, &refitted);
    if part == 0.0 {
        return Ok((evidence, refitted, part));
    }
    let (later, better) = prepared(subject, by_instants(stretches, part), near)?;
    let is_mended = early_part(subject, &better) == 0.0;
    Ok(if is_mended { (later, better, part) } else { (evidence, refitted, 0.0) })
}

/// Stretches whose commands act earlier by a part of their sample period.
pub fn by_instants(mut stretches: Vec<Stretch>, part: f64) -> Vec<Stretch> {
    stretches.iter_mut().for_each(|stretch| stretch.act_later(part * -stretch.sampled_s));
    stretches
}

/// The part of a sample period by which commands act before the intervals of their rows: that of the middle joint, where
/// nearly all joints are early; else 0, and 0 where logs of several rates would have to agree. The three-joint robot's
/// board logs what it holds.
pub fn early_part(subject: &Subject, model: &FittedModel) -> f64 {
    let (linear, stretches) = (&model.linear, &model.evidence.stretches);
    let period_s = stretches[0].sampled_s;
    let same = subject.criteria.rows.same_rate_part;
    let is_same_rate = |stretch: &Stretch| (stretch.sampled_s / period_s - 1.0).abs() < same;
    if linear.hypothesis.plant.as_chain().is_none() || !stretches.iter().all(is_same_rate) {
        return 0.0;
    }
    let lag = |(place, expected): (usize, &Expected)| {
        let is_lag = matches!(expected.unknown, Unknown::Lag(_));
        let told = || linear.deviation(place) < 0.5 * expected.deviation;
        (is_lag && told()).then(|| -expected.unknown.get(&linear.hypothesis) / period_s)
    };
    let early: Vec<f64> = linear.expected.iter().enumerate().filter_map(lag).collect();
    middle_if_all_early(early, subject.joints.len(), &subject.criteria.logs)
}

/// The middle of the parts that the logs tell, where those are of half of the joints at least, nearly all are early, and the
/// middle is by no more than half a period and what may be missed of it: commands of whole rows before are another thing.
fn middle_if_all_early(mut early: Vec<f64>, joints: usize, criteria: &LogCriteria) -> f64 {
    early.sort_by(f64::total_cmp);
    let is_early = |part: &&f64| **part > criteria.least_early_part;
    let most = criteria.early_joints * early.len() as f64;
    let are_all = early.iter().filter(is_early).count() as f64 >= most;
    match early.get(early.len() / 2) {
        Some(middle)
            if are_all && 2 * early.len() >= joints && *middle < criteria.most_early_part =>
        {
            middle.min(0.5)
        }
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_are_early_where_nearly_all_joints_are() {
        let criteria = LogCriteria::default();
        let part = |early: &[f64]| middle_if_all_early(early.to_vec(), 6, &criteria);
        assert_eq!(part(&[0.47, 0.49, 0.02, 0.48, 0.46, 0.47]), 0.47);
        assert_eq!(part(&[0.5, 0.6, 0.55]), 0.5);
        assert_eq!(part(&[0.47, 0.48]), 0.0);
        assert_eq!(part(&[0.47, 0.01, 0.03]), 0.0);
        assert_eq!(part(&[-0.4, -0.5, -0.4]), 0.0);
        assert_eq!(part(&[1.0, 1.02, 0.98, 1.0]), 0.0);
        assert_eq!(part(&[]), 0.0);
    }
}
