//! Logs whose commands are those of the instants at which rows were read, not of the intervals that begin there.
//!
//! A robot's controller runs faster than its log: of every so many commands one is kept, as of the instant of its row. Over
//! the interval it is on average what lies between it and the next one, half a period later than a row says. Taken as
//! held, all joints seem to be driven early by half a period, a lag below zero that no drive has.

use super::fitted_model::FittedModel;
use super::preparation::prepared;
use super::unknowns::Unknown;
use crate::criteria::LogCriteria;
use crate::logs::stretch::Stretch;
use crate::logs::subject::Subject;
use crate::rows::evidence::Evidence;
use crate::trial::hypothesis::Hypothesis;
use recordings::StepError;

/// The rows, the model refitted to them, and by what part of a sample period commands were read too early.
pub type Prepared = (Evidence, FittedModel, f64);

/// Prepares stretches as [`prepared`] does, their commands as of the instants of rows where the refitted model says so.
///
/// # Errors
/// The logs are too short to see their noise, or do not determine the model.
pub fn prepared_by_instants(
    subject: &Subject,
    mut stretches: Vec<Stretch>,
    near: Option<&Hypothesis>,
) -> Result<Prepared, StepError> {
    let (evidence, refitted) = prepared(subject, stretches.clone(), near)?;
    let part = early_part(&refitted, &subject.criteria.logs);
    if part == 0.0 {
        return Ok((evidence, refitted, part));
    }
    stretches.iter_mut().for_each(|stretch| stretch.act_later(-part * stretch.sampled_s));
    let (evidence, refitted) = prepared(subject, stretches, near)?;
    Ok((evidence, refitted, part))
}

/// The part of a sample period by which commands act before the intervals of their rows, half of one at most: that of
/// the middle joint, where nearly all joints whose lag is told are early; else 0.
fn early_part(model: &FittedModel, criteria: &LogCriteria) -> f64 {
    let (linear, period_s) = (&model.linear, model.evidence.stretches[0].sampled_s);
    let lag = |(place, expected): (usize, &super::unknowns::Expected)| {
        let is_lag = matches!(expected.unknown, Unknown::Lag(_));
        let told = || linear.deviation(place) < 0.5 * expected.deviation;
        (is_lag && told()).then(|| -expected.unknown.get(&linear.hypothesis) / period_s)
    };
    let early: Vec<f64> = linear.expected.iter().enumerate().filter_map(lag).collect();
    middle_if_all_early(early, criteria)
}

fn middle_if_all_early(mut early: Vec<f64>, criteria: &LogCriteria) -> f64 {
    early.sort_by(f64::total_cmp);
    let is_early = |part: &&f64| **part > criteria.least_early_part;
    let most = criteria.early_joints * early.len() as f64;
    let are_all = early.iter().filter(is_early).count() as f64 >= most;
    match early.get(early.len() / 2) {
        Some(middle) if are_all => middle.min(0.5),
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_are_early_where_nearly_all_joints_are() {
        let criteria = LogCriteria::default();
        let part = |early: &[f64]| middle_if_all_early(early.to_vec(), &criteria);
        assert_eq!(part(&[0.47, 0.49, 0.02, 0.48, 0.46, 0.47]), 0.47);
        assert_eq!(part(&[0.6, 0.7, 0.55]), 0.5);
        assert_eq!(part(&[0.47, 0.01, 0.03]), 0.0);
        assert_eq!(part(&[-0.4, -0.5, -0.4]), 0.0);
        assert_eq!(part(&[]), 0.0);
    }
}
