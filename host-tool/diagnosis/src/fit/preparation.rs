//! From a campaign to a refitted model on rows that are white.

use super::bristles::with_likely_bristles;
use super::fitted_model::FittedModel;
use super::gauss_newton::fit;
use super::inertia::lightest;
use super::kicks::known_part;
use crate::logs::sampling_jitter::jitter_s;
use crate::logs::stretch::Stretch;
use crate::logs::subject::Subject;
use crate::rows::evidence::Evidence;
use crate::rows::noise::{Noise, NoiseByRate, of_encoder, of_white_angles};
use crate::trial::equation::Trial;
use crate::trial::hypothesis::{EffectInstance, Hypothesis};
use recordings::StepError;

/// The rows, and the model refitted to those of train logs: from the model as given, and from `near`, a
/// model that fits them, where there is one. The better is kept: a fit whose parameters are all but free
/// may end where a joint's rows are left so large that they weigh nothing.
///
/// # Errors
/// The logs are too short to see their noise, or do not determine the model.
pub fn prepared(
    subject: &Subject,
    stretches: Vec<Stretch>,
    near: Option<&Hypothesis>,
) -> Result<(Evidence, FittedModel), StepError> {
    let steps = &subject.criteria.fit;
    let given = as_given(subject);
    let evidence = with_noise(subject, stretches, &given)?;
    let given = with_likely_bristles(&evidence, subject, given);
    let rough = fit(&evidence, subject, given, steps.first_steps).ok_or_else(undetermined)?;
    let evidence = with_noise(subject, evidence.stretches.to_vec(), &rough.hypothesis)?;
    let refitted = |start: Hypothesis| {
        let fitted = FittedModel::fitted(&evidence, subject, start, steps.refit_steps)?;
        Some(fitted.settled(subject))
    };
    let from_given = refitted(rough.hypothesis).ok_or_else(undetermined)?;
    let from_near = near.and_then(|near| refitted(near.clone()));
    let better = from_near.filter(|model| model.gain_over(&from_given) > 0.0);
    Ok((evidence, better.unwrap_or(from_given)))
}

fn undetermined() -> StepError {
    let what = "the logs do not determine the model's parameters; record motion of every joint";
    StepError::Numerical { step: "diagnosis", what: what.into() }
}

/// Stretches as rows, weighted by the noise in what a model leaves of them.
fn with_noise(
    subject: &Subject,
    stretches: Vec<Stretch>,
    hypothesis: &Hypothesis,
) -> Result<Evidence, StepError> {
    let noise = noise(subject, &stretches, hypothesis);
    for (&joint, number) in subject.joints.iter().zip(&subject.numbers) {
        if !noise.knows(joint) {
            let what = format!(
                "the logs are too short, or too slowly sampled, to see the noise of joint \
                 {number}; record 5 s or more at 60 Hz or more"
            );
            return Err(StepError::Numerical { step: "diagnosis", what });
        }
    }
    let evidence = Evidence::new(stretches, subject.joints.clone(), &noise, &subject.criteria);
    Ok(evidence.with_known_parts(|evidence, joint, s| known_part(evidence, hypothesis, joint, s)))
}

/// Noise of every joint's rows in each stretch, rms [V], seen in what the last model of a search
/// leaves: a gap that is always there passes for noise until its cause is found. Behind a spring it is no more than the
/// floor of the rows: its model differentiates the angles four times, and what it makes of their noise is not the logs'.
pub fn noise_left_v(subject: &Subject, evidence: &Evidence, last: &FittedModel) -> Vec<Vec<f64>> {
    let noise = noise(subject, &evidence.stretches, &last.linear.hypothesis);
    let has_spring = last.linear.hypothesis.effects.iter().any(EffectInstance::is_spring);
    let of_stretch = |joint: usize, s: usize| {
        let (filter, period_s) = (evidence.filter(joint, s), evidence.stretches[s].period_s);
        let seen = noise.in_stretch(joint, &evidence.stretches[s]);
        let seen_v = seen.behind(|f| filter.gain(f), period_s);
        if has_spring { seen_v.min(evidence.floor_v(joint, s)) } else { seen_v }
    };
    let of_joint =
        |joint: usize| (0..evidence.stretches.len()).map(|s| of_stretch(joint, s)).collect();
    (0..evidence.joint_count()).map(of_joint).collect()
}

/// The model as given, with all that is known of it by then.
pub fn as_given(subject: &Subject) -> Hypothesis {
    Hypothesis {
        effects: subject.known_effects.iter().map(EffectInstance::told).collect(),
        tables: subject.known_tables.clone(),
        ..Hypothesis::bare(subject.plant.clone())
    }
}

/// The same without torque constants that are in doubt, which the file does not hold.
pub fn in_file(subject: &Subject) -> Hypothesis {
    let mut given = as_given(subject);
    given.effects.truncate(subject.given_effects);
    given
}

/// Noise of each joint in what a model leaves of logs without driven noise, or of all logs
/// where there are no others; rate by rate.
fn noise(subject: &Subject, stretches: &[Stretch], hypothesis: &Hypothesis) -> NoiseByRate {
    let (step_rad, criteria) = (&subject.encoder_step_rad, &subject.criteria);
    let is_same_rate = |a_s: f64, b_s: f64| (a_s / b_s - 1.0).abs() < criteria.rows.same_rate_part;
    let calm: Vec<&Stretch> = stretches.iter().filter(|s| !s.broadband).collect();
    let used = if calm.is_empty() { stretches.iter().collect() } else { calm };
    let mut noise = NoiseByRate::default();
    let mut rates_s: Vec<f64> = Vec::new();
    for stretch in &used {
        let Stretch { period_s, sampled_s, .. } = **stretch;
        if rates_s.iter().any(|rate_s| is_same_rate(*rate_s, sampled_s)) {
            continue;
        }
        rates_s.push(sampled_s);
        let alike = used.iter().filter(|other| is_same_rate(other.sampled_s, sampled_s));
        let trials: Vec<Trial> =
            alike.clone().map(|stretch| Trial::of(stretch, hypothesis, &criteria.fit)).collect();
        let of_joint = |joint: usize| {
            let left: Vec<Vec<f64>> = trials.iter().map(|trial| trial.residual(joint)).collect();
            let left: Vec<&[f64]> = left.iter().map(|rows| &rows[..]).collect();
            Noise::of(&left, period_s, &criteria.rows)
        };
        let inertia2 = |joint: usize| lightest(stretch, hypothesis, joint).powi(2);
        let of_steps = |joint: usize| of_encoder(step_rad[joint], sampled_s) * inertia2(joint);
        let jitter_rad2 = jitter_s(alike.clone().flat_map(|stretch| &stretch.roughness)).powi(2);
        let of_jitter = |joint: usize| of_white_angles(jitter_rad2, sampled_s) * inertia2(joint);
        let joints = 0..subject.plant.joints();
        let seen: Vec<Option<Noise>> = joints.clone().map(of_joint).collect();
        noise.push(sampled_s, &seen, joints.clone().map(of_steps).collect());
        noise.push_jitter(sampled_s, joints.map(of_jitter).collect());
    }
    noise
}
