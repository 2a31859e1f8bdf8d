//! The best candidates, refitted together with everything else in the model.

use rayon::prelude::*;

use super::candidate::Candidate;
use super::candidates::{candidates, places_open};
use super::independent_rows::by_independent_rows;
use super::policy::is_more_than;
use super::promise::Start;
use super::refit::{Finalist, refitted};
use super::starts::EffectStarts;
use crate::fit::fitted_model::FittedModel;
use crate::fit::linearisation::Linearisation;
use crate::logs::subject::Subject;
use crate::trial::hypothesis::EffectInstance;

/// Candidates for a place in a model, refitted batch by batch: those that promise most, then those that
/// promise less, then those that were never searched because others promised more; of what is taken to be systematic
/// the first alone.
pub struct Contest<'a> {
    subject: &'a Subject,
    before: &'a FittedModel,
    now: &'a Linearisation,
    /// What every effect's starts change.
    tried: Vec<EffectStarts>,
    /// Candidates that were not refitted yet, the best first.
    promising: Vec<Candidate>,
    /// The best start of every effect on every joint.
    first_starts: Vec<Start>,
    /// Batches that may still be refitted.
    batches: usize,
    /// Whether those sought by independent rows were refitted too.
    widened: bool,
    /// Those that were refitted, the best first.
    pub finalists: Vec<Finalist>,
}

impl<'a> Contest<'a> {
    /// For a place beside the effects of the model `before`; `now` is that model linearised where
    /// effects are searched from.
    pub fn of(subject: &'a Subject, before: &'a FittedModel, now: &'a Linearisation) -> Self {
        let places = places_open(subject, &now.hypothesis.effects);
        let tried = EffectStarts::at(&places, now, &before.evidence, subject);
        let starts: Vec<Vec<Start>> = tried.iter().map(|tried| tried.best(subject)).collect();
        let first_starts = starts.iter().filter_map(|starts| starts.first()).cloned().collect();
        let mut promising = candidates(starts, now, &before.evidence, subject);
        let without = now.refitted_objective();
        promising.retain(|candidate| candidate.train < without);
        // Of what is systematic only an effect pays that takes nearly all of one log: it promises most, or is sought by
        // independent rows.
        let first_batch_only = before.evidence.systematic;
        let batches = if first_batch_only { 1 } else { subject.criteria.selection.batches + 1 };
        Self {
            subject,
            before,
            now,
            tried,
            promising,
            first_starts,
            batches,
            widened: false,
            finalists: Vec::new(),
        }
    }

    /// Refits the next batch; whether there was one.
    pub fn advance(&mut self) -> bool {
        if self.batches == 0 {
            return false;
        }
        let first_batch_only = self.before.evidence.systematic;
        let is_last = self.promising.is_empty() || (self.batches == 1 && !first_batch_only);
        self.batches = if is_last { 0 } else { self.batches - 1 };
        let batch = match is_last {
            true => self.overlooked(),
            false => next_batch(&mut self.promising, self.now.refitted_objective(), self.subject),
        };
        let more = refitted(self.subject, self.before, self.now, batch);
        self.take(more);
        true
    }

    /// Refits those that are sought as if every row said something of its own, once; whether there were any.
    pub fn widen(&mut self) -> bool {
        if self.widened {
            return false;
        }
        self.widened = true;
        let more = by_independent_rows(self.subject, self.before, self.now, &self.tried);
        let any = !more.is_empty();
        self.take(more);
        any
    }

    /// Effects that were not searched because others promised more than they kept.
    fn overlooked(&self) -> Vec<Candidate> {
        let (evidence, effort) = (&self.before.evidence, &self.subject.criteria.search);
        let is_tried = |effect: &EffectInstance| {
            let same = |f: &Finalist| f.effect.has_place_of(effect);
            self.finalists.iter().any(same)
        };
        let is_left =
            |start: &&Start| start.gain > effort.least_promise && !is_tried(&start.effect);
        let mut promising: Vec<&Start> = self.first_starts.iter().filter(is_left).collect();
        promising.sort_by(|a, b| b.gain.total_cmp(&a.gain));
        promising.truncate(effort.overlooked);
        let searched = |start: &Start| {
            let first = Candidate::of(self.now, evidence, start.effect.clone()).0;
            first.refined(self.now, evidence, effort.overlooked_steps)
        };
        let mut found: Vec<Candidate> = promising.into_par_iter().map(searched).collect();
        found.sort_by(|a, b| a.train.total_cmp(&b.train));
        found.truncate(self.subject.criteria.selection.finalists);
        found
    }

    fn take(&mut self, more: Vec<Finalist>) {
        self.finalists.extend(more);
        rank(self.before, &mut self.finalists);
        simpler_first(&mut self.finalists, self.subject.criteria.selection.least_log_likelihood);
    }
}

/// The first of those that are one effect with other values: fits of one cause from several starts.
pub fn each_once(finalists: Vec<Finalist>) -> Vec<Finalist> {
    let mut kept: Vec<Finalist> = Vec::new();
    for finalist in finalists {
        if !kept.iter().any(|other| other.effect.is_same_cause(&finalist.effect)) {
            kept.push(finalist);
        }
    }
    kept
}

/// Puts an effect behind a simpler one that it contains, where it gains hardly more than that.
fn simpler_first(finalists: &mut [Finalist], least: f64) {
    for k in 1..finalists.len() {
        let before = |at: usize, finalists: &[Finalist]| {
            is_more_than(&finalists[at].effect, &finalists[k].effect)
                && finalists[at].gain < finalists[k].gain + least
        };
        if let Some(at) = (0..k).find(|&at| before(at, finalists)) {
            finalists[at..=k].rotate_right(1);
        }
    }
}

/// Sorts finalists, the best first; rows of all of them count as independent as in what that one
/// leaves that lasts least, of those that gain anything.
fn rank(before: &FittedModel, finalists: &mut [Finalist]) {
    let gaining = finalists.iter().filter(|finalist| finalist.gain > 0.0);
    let misfits = gaining.map(|finalist| finalist.model.misfit());
    let common = misfits
        .fold(before.misfit().clone(), |common, misfit| common.at_least_as_independent(misfit));
    let without = before.log_likelihood(&common);
    for finalist in finalists.iter_mut() {
        finalist.gain = finalist.model.log_likelihood(&common) - without;
    }
    finalists.sort_by(|a, b| b.gain.total_cmp(&a.gain));
}

/// Takes the best of those that are left and those that promise nearly as much, and the best of every
/// other joint: what one hides of another's command may leave its rows little weight, and then they
/// promise little, whatever is found.
fn next_batch(promising: &mut Vec<Candidate>, without: f64, subject: &Subject) -> Vec<Candidate> {
    let policy = &subject.criteria.selection;
    let gain = |candidate: &Candidate| without - candidate.train;
    let least = policy.finalist_gain * promising.first().map_or(0.0, gain);
    let alike = promising.iter().take_while(|candidate| gain(candidate) > least).count();
    let alike = alike.clamp(1, policy.finalists).min(promising.len());
    let mut batch: Vec<Candidate> = promising.drain(..alike).collect();
    for joint in 0..=subject.plant.joints() as u8 {
        let of_joint = |candidate: &Candidate| candidate.effect.joint == joint;
        if !batch.iter().any(of_joint) {
            let best = promising.iter().position(of_joint);
            batch.extend(best.map(|at| promising.remove(at)));
        }
    }
    batch
}
