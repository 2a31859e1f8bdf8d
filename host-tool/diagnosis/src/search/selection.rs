//! Which effects belong into the model: one after the other, each the best of all, as long
//! as each takes a good part of what is left.

use rayon::prelude::*;

use super::candidate::Candidate;
use super::fitted_model::{FittedModel, SPRING_STEPS};
use super::restart::restarted;
use crate::fit::gauss_newton::fit;
use crate::fit::linearisation::{Linearisation, Which};
use crate::fit::preparation::as_given;
use crate::fit::residual_stats::{PRIOR_PENALTY, ResidualStats};
use crate::logs::subject::Subject;
use crate::rows::evidence::Evidence;
use crate::search::candidates::{Start, candidates, places_open, starts};
use crate::trial::hypothesis::{EffectInstance, Hypothesis};
use rig::effects::Definition;

/// The model after each step, and what competed.
pub struct Selection {
    /// The refitted model.
    pub refitted: FittedModel,
    /// The same with one effect more each.
    pub added: Vec<FittedModel>,
    /// Candidates that lost, in the round in which they were best, the best first.
    pub rivals: Vec<Rivalry>,
}

/// A candidate that lost against an effect that was taken.
#[derive(Clone, Debug)]
pub struct Rivalry {
    /// Index of the effect among those taken; their count where none was taken.
    pub round: usize,
    /// The candidate, retuned with everything else.
    pub candidate: Candidate,
    /// What the model leaves with it.
    pub stats: ResidualStats,
}

/// Most effects in a model.
const MOST_EFFECTS: usize = 3;
/// Candidates that are retuned with everything else before one is taken.
const FINALISTS: usize = 5;
/// How often others are retuned where none of them is any good.
const MOST_BATCHES: usize = 4;
/// Effects that are looked at where those that promised most do not keep it.
const MOST_OVERLOOKED: usize = 10;
/// A finalist has gained at least this part of the best candidate's gain.
const FINALIST_GAIN: f64 = 0.4;
/// Steps of a fit of a finalist.
const FINALIST_STEPS: usize = 2;
/// Steps of a fit of the one that is taken.
const TAKEN_STEPS: usize = 4;
/// How often play is searched for anew from near where it was found.
const MOST_RESTARTS: usize = 3;
/// Part of the excess that an effect must take away.
const LEAST_PART: f64 = 0.2;
/// A model that leaves less than this of what encoder steps must leave takes it for motion,
/// where there was hardly more than that before.
const BELOW_NOISE: f64 = 0.7;
const NEAR_NOISE: f64 = 2.0;
/// What an effect that brings parameters back to what is known of them may cost in rows: those
/// parameters had been bent to fit every detail.
const ROWS_FOR_PRIOR_PENALTY: f64 = 1.15;
const HELD_OUT_FOR_PRIOR_PENALTY: f64 = 1.5;
/// An effect takes parameters further beyond belief when it multiplies their prior penalty by this.
const FURTHER: f64 = 1.2;
/// Part of all squares, and of those held out, that it must take away: less is at the edge
/// of what is an excess.
const LEAST_OF_ALL: f64 = 0.05;

/// Adds effects to a refitted model; `progress` hears what is tried.
pub fn select(
    evidence: &Evidence,
    subject: &Subject,
    refitted: Linearisation,
    progress: &dyn Fn(&str),
) -> Selection {
    let refitted = FittedModel::of(evidence, refitted);
    let mut selection = Selection { refitted, added: Vec::new(), rivals: Vec::new() };
    for round in 0..MOST_EFFECTS {
        progress(&format!("trying every effect on every joint, round {}", round + 1));
        let now = selection.before(round);
        if now.stats.is_clean() || is_as_good_as_clean(&selection.refitted.stats, &now.stats) {
            break;
        }
        let Some(untuned) = untuned(evidence, subject, &now.linear) else { break };
        let mut finalists = finalists(evidence, subject, &untuned, &now.stats);
        let paying = finalists.iter().position(|finalist| is_worth_it(&now.stats, &finalist.1));
        let taken = paying.map(|place| finalists.remove(place));
        let lost = finalists.into_iter().map(|(candidate, step)| Rivalry {
            round,
            candidate,
            stats: step.stats,
        });
        selection.rivals.extend(lost);
        match taken {
            Some((_, step)) => {
                let finished = finished(evidence, subject, step);
                // What fits better in the end may yet foretell worse.
                let effects = &finished.linear.hypothesis.effects;
                let physical = effects.iter().all(|e| is_physical(e, subject, evidence));
                if !physical || !is_worth_it(&selection.before(round).stats, &finished) {
                    break;
                }
                selection.added.push(finished);
            }
            None => break,
        }
    }
    progress("leaving out what is not needed");
    selection.pruned(evidence, subject)
}

impl Selection {
    /// The model with all effects that were taken.
    pub fn last(&self) -> &FittedModel {
        self.added.last().unwrap_or(&self.refitted)
    }

    /// The model to which a round of the search, counted from 0, adds.
    pub fn before(&self, round: usize) -> &FittedModel {
        self.added[..round.min(self.added.len())].last().unwrap_or(&self.refitted)
    }

    /// Without effects that others, taken later, make needless: an offset goes once the
    /// spring is found that it stood for.
    fn pruned(mut self, evidence: &Evidence, subject: &Subject) -> Self {
        let known = subject.known_effects.len();
        let mut index = 0;
        while index + 1 < self.added.len() {
            let last = self.last();
            let mut hypothesis = last.linear.hypothesis.clone();
            hypothesis.effects.remove(known + index);
            let without = fit(evidence, subject, hypothesis, TAKEN_STEPS);
            match without.map(|linear| FittedModel::of(evidence, linear)) {
                Some(without) if !pays(&without.stats, &last.stats) => {
                    self.leave_out(evidence, subject, index, without);
                }
                _ => index += 1,
            }
        }
        self
    }

    /// Takes an effect out of all models after it; `last` is the last of them.
    fn leave_out(
        &mut self,
        evidence: &Evidence,
        subject: &Subject,
        index: usize,
        last: FittedModel,
    ) {
        let effects = last.linear.hypothesis.effects.clone();
        let known = subject.known_effects.len();
        self.added.truncate(index);
        for count in known + index + 1..effects.len() {
            let mut hypothesis = last.linear.hypothesis.clone();
            hypothesis.effects.truncate(count);
            let step = fit(evidence, subject, hypothesis, TAKEN_STEPS);
            self.added.extend(step.map(|linear| FittedModel::of(evidence, linear)));
        }
        self.added.push(last);
        self.rivals.retain(|rival| rival.round != index);
        for rival in self.rivals.iter_mut().filter(|rival| rival.round > index) {
            rival.round -= 1;
        }
    }
}

/// A step whose fit is carried on to its end.
fn finished(evidence: &Evidence, subject: &Subject, step: FittedModel) -> FittedModel {
    let is_spring = step.linear.hypothesis.effects.last().is_some_and(EffectInstance::is_spring);
    let steps = if is_spring { SPRING_STEPS } else { TAKEN_STEPS };
    let fitted = fit(evidence, subject, step.linear.hypothesis.clone(), steps);
    let mut best = fitted.map_or(step, |linear| FittedModel::of(evidence, linear));
    for _ in 0..MOST_RESTARTS {
        match restarted(evidence, subject, &best) {
            Some(better) => best = better,
            None => break,
        }
    }
    best
}

/// The effects of a retuned model in the model as given. Effects are searched for from
/// there: what retuning bends to hide a missing effect only leads a search astray.
fn untuned(
    evidence: &Evidence,
    subject: &Subject,
    retuned: &Linearisation,
) -> Option<Linearisation> {
    let hypothesis =
        Hypothesis { effects: retuned.hypothesis.effects.clone(), ..as_given(subject) };
    Linearisation::of(evidence, hypothesis, retuned.expected.clone())
}

/// The best candidates, retuned with everything else, the best first: of those that promise
/// most, and where none of them keeps its promise and pays, of those that promise less.
fn finalists(
    evidence: &Evidence,
    subject: &Subject,
    now: &Linearisation,
    rest: &ResidualStats,
) -> Vec<(Candidate, FittedModel)> {
    let before = now.score().total();
    let mut promising = candidates(now, evidence, subject);
    promising.retain(|candidate| candidate.score.total() < before);
    let mut finalists = Vec::new();
    for _ in 0..MOST_BATCHES {
        let batch = next_batch(&mut promising, before);
        finalists.extend(retuned(evidence, subject, now, batch));
        if promising.is_empty() || finalists.iter().any(|(_, step)| is_worth_it(rest, step)) {
            break;
        }
    }
    if !finalists.iter().any(|(_, step)| is_worth_it(rest, step)) {
        let batch = overlooked(evidence, subject, now, &finalists);
        finalists.extend(retuned(evidence, subject, now, batch));
    }
    finalists.sort_by(|a, b| a.1.total().total_cmp(&b.1.total()));
    finalists
}

/// Effects that were not searched because others promised more than they kept.
fn overlooked(
    evidence: &Evidence,
    subject: &Subject,
    now: &Linearisation,
    tried: &[(Candidate, FittedModel)],
) -> Vec<Candidate> {
    const STEPS: usize = 3;
    let is_new = |place: &(&'static Definition, u8)| {
        let same =
            |c: &Candidate| (c.effect.definition.name, c.effect.joint) == (place.0.name, place.1);
        !tried.iter().any(|(candidate, _)| same(candidate))
    };
    let first = |(definition, joint): (&'static Definition, u8)| {
        starts(now, evidence, subject, definition, joint).into_iter().next()
    };
    let places: Vec<(&'static Definition, u8)> =
        places_open(subject, &now.hypothesis.effects).into_iter().filter(is_new).collect();
    let mut promising: Vec<Start> = places.into_par_iter().filter_map(first).collect();
    promising.sort_by(|a, b| b.gain.total_cmp(&a.gain));
    promising.truncate(MOST_OVERLOOKED);
    let searched = |start: Start| {
        let begun = Candidate::of(now, evidence, start.effect, Which::TRAIN).0;
        let best = begun.refined(now, evidence, STEPS, Which::TRAIN);
        Candidate::of(now, evidence, best.effect, Which::ALL).0
    };
    let mut found: Vec<Candidate> = promising.into_par_iter().map(searched).collect();
    found.sort_by(|a, b| a.score.total().total_cmp(&b.score.total()));
    found.truncate(FINALISTS);
    found
}

/// Takes the best of those that are left, and those that promise nearly as much.
fn next_batch(promising: &mut Vec<Candidate>, before: f64) -> Vec<Candidate> {
    let gain = |candidate: &Candidate| before - candidate.score.total();
    let least = FINALIST_GAIN * promising.first().map_or(0.0, gain);
    let alike = promising.iter().take_while(|candidate| gain(candidate) > least).count();
    promising.drain(..alike.clamp(1, FINALISTS).min(promising.len())).collect()
}

fn retuned(
    evidence: &Evidence,
    subject: &Subject,
    now: &Linearisation,
    batch: Vec<Candidate>,
) -> Vec<(Candidate, FittedModel)> {
    batch
        .into_par_iter()
        .filter_map(|mut candidate| {
            let start = now.hypothesis.with(candidate.effect.clone());
            let step = FittedModel::of(evidence, fit(evidence, subject, start, FINALIST_STEPS)?);
            candidate.effect = step.linear.hypothesis.effects.last()?.clone();
            is_physical(&candidate.effect, subject, evidence).then_some((candidate, step))
        })
        .collect()
}

/// Whether a spring leaves its motor some inertia, without which it would only smooth what
/// the encoder reads, and whether its play, if it has some, is more than the spring gives.
fn is_physical(effect: &EffectInstance, subject: &Subject, evidence: &Evidence) -> bool {
    const LEAST_INERTIA: f64 = 0.02;
    const LEAST_PLAY: f64 = 0.02;
    let Some((joint, spring)) = effect.build().and_then(|effect| effect.transmission()) else {
        return true;
    };
    let command_v = evidence.stretches.iter().flat_map(|stretch| &stretch.command_v[joint]);
    let largest_v = command_v.fold(0.0, |largest, u| f64::max(largest, u.abs()));
    let largest_nm = subject.robot.torque_constant_nm_per_v[joint] * largest_v;
    let has_motor = spring.motor_inertia_kg_m2 > LEAST_INERTIA * subject.inertia_kg_m2(joint);
    let is_free = spring.gap_rad * spring.stiffness_nm_per_rad > LEAST_PLAY * largest_nm;
    has_motor && (is_free || !effect.has_backlash())
}

/// Whether so little is left of the gap that it may be the method's own: effects that are
/// not linear are not undone to the last.
fn is_as_good_as_clean(gap: &ResidualStats, rest: &ResidualStats) -> bool {
    const RATIO: f64 = 3.0;
    const PART: f64 = 5e-4;
    rest.worst() < RATIO && rest.excess < PART * gap.excess && rest.prior_penalty < PRIOR_PENALTY
}

/// Whether the last effect of a model pays. A spring rings, and that shows in the rows; where
/// those are noise alone, it could only smooth what a coarse encoder reads.
fn is_worth_it(before: &ResidualStats, after: &FittedModel) -> bool {
    let is_spring = after.linear.hypothesis.effects.last().is_some_and(EffectInstance::is_spring);
    (before.excess > 0.0 || !is_spring) && pays(before, &after.stats)
}

/// Whether an effect takes enough away, and does not do so by bending the model beyond
/// belief: an amplifier that swallows every command "explains" any motion of a robot that
/// weighs nothing. Nor by taking away noise: a soft spring smooths what encoder steps add.
fn pays(before: &ResidualStats, after: &ResidualStats) -> bool {
    if after.is_beyond_belief() && after.prior_penalty > FURTHER * before.prior_penalty {
        return false;
    }
    if after.of_steps < BELOW_NOISE && before.of_steps < NEAR_NOISE {
        return false;
    }
    let by_rows = before.excess > 0.0
        && after.excess < (1.0 - LEAST_PART) * before.excess
        && after.rows < (1.0 - LEAST_OF_ALL) * before.rows
        && after.held_out < (1.0 - LEAST_OF_ALL) * before.held_out;
    let by_misses = before.prior_penalty - after.prior_penalty
        > PRIOR_PENALTY.max(0.5 * before.prior_penalty)
        && after.rows < ROWS_FOR_PRIOR_PENALTY * before.rows
        && after.held_out < HELD_OUT_FOR_PRIOR_PENALTY * before.held_out;
    by_rows || by_misses
}
