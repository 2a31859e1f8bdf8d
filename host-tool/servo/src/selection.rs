//! Effects of one joint, one after the other, by what they leave of logs left out.

use rayon::prelude::*;

use crate::base::{Base, Frame};
use crate::candidates::{Candidate, Typical, of_joint};
use crate::cogging_orders::cogging_orders;
use crate::cross::{Gain, LeftOut};
use crate::fit::{Problem, fit};
use crate::joint_model::{Model, Tried};
use crate::judged::Judged;
use crate::ranking::{Over, as_tried, confirmed, ranked, rivals};
use crate::screen::Screen;

/// What was selected for a joint.
#[derive(Clone, Debug)]
pub struct Selected {
    /// Without effects.
    pub base: Model,
    /// With those that were added.
    pub model: Model,
    /// What each gained on logs left out, in the model's order.
    pub added: Vec<Gain>,
    /// Effects that would come next and do the same, so that none of them is added.
    pub undecided: Vec<Tried>,
    /// All effects over the base alone, best first.
    pub tried: Vec<Tried>,
}

/// Effects of a joint, from 0.
pub fn select(frame: &Frame, joint: usize, base: &Base) -> Selected {
    let first = Model::of_base(frame, joint, base);
    let typical = Typical::of(base, frame.logs, joint);
    let orders = cogging_orders(frame, joint, &base.fitted.servo);
    let place = Place { frame, joint, base };
    let mut open = of_joint(base, &typical, &orders);
    let mut found = Selected {
        base: first.clone(),
        model: first,
        added: Vec::new(),
        undecided: Vec::new(),
        tried: Vec::new(),
    };
    while found.model.effects.len() < frame.settings.most_effects
        && place.add(&mut found, &mut open)
    {}
    found
}

/// Where effects are sought.
struct Place<'a> {
    frame: &'a Frame<'a>,
    joint: usize,
    base: &'a Base,
}

impl Place<'_> {
    /// Adds the effect that gains most, of those that are open; whether there was one.
    fn add(&self, found: &mut Selected, open: &mut Vec<Candidate>) -> bool {
        let Self { frame, joint, base } = *self;
        let mut over = self.over(&found.model, open);
        let all: Vec<Tried> = over.iter().map(as_tried).collect();
        if found.tried.is_empty() {
            found.tried.clone_from(&all);
        }
        let Some((best, gain)) = confirmed(frame, joint, base.scale, &found.model, &over) else {
            return false;
        };
        let rivals = rivals(&over, best, &gain, frame.settings);
        if !rivals.is_empty() {
            found.undecided = [all[best].clone()].into_iter().chain(rivals).collect();
            return false;
        }
        let Over { effect, model: mut next, .. } = over.swap_remove(best);
        next.polish(frame, joint, base.scale);
        found.added.push(gain);
        // What did nothing over the base does nothing beside an effect, either.
        let least = 0.25 * frame.settings.least_gain;
        let gains = |o: &Candidate| all.iter().any(|t| t.effect == o.effect && t.gain.part > least);
        open.retain(|other| other.effect != effect.effect && gains(other));
        found.model = next;
        true
    }

    /// The promising effects over a model, likeliest first.
    fn over(&self, model: &Model, open: &[Candidate]) -> Vec<Over> {
        let Self { frame, joint, base } = *self;
        let logs = worst(frame, &model.left);
        let short = Frame { logs: &logs, ..*frame };
        let problem = short.problem(joint, &model.unknowns, base.scale);
        let screen = Screen::of(&problem, &model.fitted.servo);
        let least = 0.25 * frame.settings.least_gain;
        let open: Vec<Candidate> =
            open.par_iter().filter_map(|effect| screen.promising(effect, least)).collect();
        let open = match logs.len() == frame.logs.len() {
            true => open,
            false => promising(&short, joint, base, model, &open),
        };
        let problem = frame.problem(joint, &model.unknowns, base.scale);
        let found = open.par_iter().filter_map(|effect| over(frame, joint, base, model, effect));
        ranked(&problem, model, found.collect())
    }
}

/// An effect over a model.
fn over(
    frame: &Frame,
    joint: usize,
    base: &Base,
    model: &Model,
    effect: &Candidate,
) -> Option<Over> {
    let with = model.with(frame, joint, base.scale, effect)?;
    let gain = Gain::of(&with.left, &model.left);
    Some(Over { effect: effect.clone(), model: with, gain, evidence: 0.0 })
}

/// The logs of which a model leaves most, up to a length in all.
fn worst<'a>(frame: &Frame<'a>, left: &LeftOut) -> Vec<&'a Judged> {
    let mut order: Vec<usize> = (0..frame.logs.len()).collect();
    order.sort_by(|a, b| left.robust[*b].total_cmp(&left.robust[*a]));
    let mut seconds = 0.0;
    let within = |log: &&Judged| {
        let enough = seconds < frame.settings.screened_s;
        seconds += log.record.time_s.last().unwrap_or(&0.0) - log.record.time_s[0];
        enough
    };
    order.into_iter().map(|k| frame.logs[k]).take_while(within).collect()
}

/// The effects that gain most on the frame's logs, those of which the model leaves most.
fn promising(
    frame: &Frame,
    joint: usize,
    base: &Base,
    model: &Model,
    open: &[Candidate],
) -> Vec<Candidate> {
    let settings = frame.settings;
    let problem = frame.problem(joint, &model.unknowns, base.scale);
    let fitted = fit(&Problem { iterations: 3, ..problem }, &model.fitted.servo);
    let left = LeftOut::of_fit(&fitted, &problem);
    let model = Model { fitted, left, ..model.clone() };
    let over = |effect: &Candidate| over(frame, joint, base, &model, effect);
    let mut found: Vec<Over> = open.par_iter().filter_map(over).collect();
    found.sort_by(|a, b| b.gain.part.total_cmp(&a.gain.part));
    found.truncate(settings.screened);
    let enough = |found: &Over| found.gain.part > 0.5 * settings.least_gain;
    found.into_iter().filter(enough).map(|found| found.effect).collect()
}
