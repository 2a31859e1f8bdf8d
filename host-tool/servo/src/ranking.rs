//! Which of the effects over a model is the likeliest, whether it stands, and what does the same.

use crate::base::Frame;
use crate::candidates::Candidate;
use crate::cross::Gain;
use crate::evidence::{evidence, rows_in_one};
use crate::fit::Problem;
use crate::joint_model::{Model, Tried};
use crate::settings::Settings;

/// An effect over a model.
#[derive(Clone, Debug)]
pub struct Over {
    /// Which.
    pub effect: Candidate,
    /// What it makes of the model.
    pub model: Model,
    /// What it gains on the logs fitted to.
    pub gain: Gain,
    /// Logarithm of its likelihood.
    pub evidence: f64,
}

/// Likeliest first; `problem` and `model` without them.
pub fn ranked(problem: &Problem, model: &Model, mut found: Vec<Over>) -> Vec<Over> {
    let left = |over: &Over| over.model.left.robust.iter().sum::<f64>();
    let Some(best) = found.iter().min_by(|a, b| left(a).total_cmp(&left(b))) else { return found };
    let rows = model.fitted.squares().1 as f64 / rows_in_one(problem, &best.model.fitted.servo);
    let without: f64 = model.left.robust.iter().sum();
    for over in &mut found {
        let ratio = without / over.model.left.robust.iter().sum::<f64>().max(f64::MIN_POSITIVE);
        over.evidence = evidence(&over.effect, ratio, rows);
    }
    found.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
    found
}

/// Whether a gain is enough.
pub fn suffices(gain: &Gain, settings: &Settings) -> bool {
    let halves = gain.halves.iter().all(|half| *half >= settings.least_half_shrinkage);
    gain.part >= settings.least_gain && gain.certainty >= settings.least_certainty && halves
}

/// The likeliest effect whose gain stands on logs left out, too, and its gain there.
pub fn confirmed(
    frame: &Frame,
    joint: usize,
    scale: f64,
    before: &Model,
    found: &[Over],
) -> Option<(usize, Gain)> {
    let settings = |over: &Over| over.model.settings(frame.settings);
    let promising = |k: &usize| suffices(&found[*k].gain, &settings(&found[*k]));
    let mut promising = (0..found.len()).filter(promising).peekable();
    promising.peek()?;
    let other = before.left_out(frame, joint, scale);
    promising.find_map(|k| {
        let gain = Gain::of(&found[k].model.left_out(frame, joint, scale), &other);
        suffices(&gain, &settings(&found[k])).then_some((k, gain))
    })
}

/// Other effects that do the same as the best one. Where that leaves hardly more than noise, those that are
/// not much less likely; else those that gain as much, but for those that certainly leave more, and for those
/// that take more parameters to leave no less: a spring that rests far away is an offset.
pub fn rivals(over: &[Over], of: usize, gain: &Gain, settings: &Settings) -> Vec<Tried> {
    let best = &over[of];
    let near = settings.rival_part * gain.part;
    let leaves_more = |model: &Model| {
        let apart = Gain::of(&best.model.left, &model.left);
        apart.part >= settings.apart_part && apart.certainty >= settings.apart_certainty
    };
    let is_told = best.model.is_near_noise(settings);
    let is_rival = |other: &&Over| {
        if is_told {
            let is_near = best.evidence - other.evidence < settings.apart_evidence;
            return is_near && suffices(&other.gain, &other.model.settings(settings));
        }
        let is_simple = other.effect.unknowns.len() <= best.effect.unknowns.len();
        other.gain.part >= near && is_simple && !leaves_more(&other.model)
    };
    let others = over.iter().filter(|other| other.effect.effect != best.effect.effect);
    others.filter(is_rival).map(as_tried).collect()
}

/// As reports have it.
pub fn as_tried(over: &Over) -> Tried {
    let value = |unknown: &crate::fit::Unknown| unknown.field.of(&over.model.fitted.servo);
    let values = over.effect.unknowns.iter().map(value).collect();
    Tried { effect: over.effect.effect, values, gain: over.gain.clone(), evidence: over.evidence }
}
