//! Torque constants that are told against each other only.
//!
//! A factor that all of them have in common is in the doubt about masses: with everything that is moved heavier by the same
//! factor, commands are the same. A search finds the fewest constants that explain the logs, each against those that it
//! leaves as given. With all of them open, those may be off as well, and some of the others not at all.

use std::collections::BTreeMap;

use crate::fit::fitted_model::FittedModel;
use crate::fit::gauss_newton::open_in;
use crate::fit::linearisation::Linearisation;
use crate::fit::unknowns::{Expected, Unknown, range};
use crate::logs::subject::Subject;
use crate::search::found::KnownCauses;
use crate::trial::hypothesis::{EffectInstance, Hypothesis};

/// Torque constants as they are with all of them open, where a model holds some.
pub struct OpenConstants {
    /// Those of all joints but those that are told, each off by what is likeliest.
    in_doubt: Vec<EffectInstance>,
    /// The 95 % interval of each that the model holds, by its joint (from 1).
    found: BTreeMap<u8, [f64; 2]>,
    /// Whether a constant that the model holds is not told: with all open, it may be zero, or have the other sign.
    pub ask_for_search: bool,
}

/// The torque constants of all joints, where there are several and a model holds some.
pub fn open_constants(subject: &Subject, last: &FittedModel) -> Option<OpenConstants> {
    let found = found(subject, &last.linear.hypothesis);
    let like = found.first().filter(|_| subject.joints.len() > 1)?;
    let all = with_all(subject, &last.linear.hypothesis, like);
    let estimates = estimates(subject, last, all)?;
    let is_found = |estimate: &&Estimate| has_place_of(&found, &estimate.constant);
    let of_found = estimates.iter().filter(is_found);
    let intervals = of_found.map(|found| (found.constant.joint, found.interval())).collect();
    let is_told = |estimate: &Estimate| found.iter().any(|found| estimate.tells(found));
    let (told, in_doubt): (Vec<Estimate>, Vec<Estimate>) = estimates.into_iter().partition(is_told);
    Some(OpenConstants {
        ask_for_search: told.len() < found.len(),
        in_doubt: in_doubt.into_iter().map(|estimate| estimate.constant).collect(),
        found: intervals,
    })
}

/// A torque constant as it is with all of them open, and half its 95 % interval.
struct Estimate {
    constant: EffectInstance,
    half: f64,
}

impl Estimate {
    fn interval(&self) -> [f64; 2] {
        [off(&self.constant) - self.half, off(&self.constant) + self.half]
    }

    /// Whether it is surely off, and to the side to which a constant was found to be.
    fn tells(&self, found: &EffectInstance) -> bool {
        let (open, found_off) = (off(&self.constant), off(found));
        self.constant.has_place_of(found) && open * found_off > 0.0 && open.abs() > self.half
    }
}

/// The torque constants of a model that holds those of all joints, by the slopes of the `last` one, each as doubtful.
fn estimates(subject: &Subject, last: &FittedModel, all: Hypothesis) -> Option<Vec<Estimate>> {
    let is_constant = |index: &usize| all.effects[*index].is_torque_constant();
    let own = (subject.known_effects.len()..all.effects.len()).filter(is_constant);
    let own: Vec<usize> = own.collect();
    let is_of =
        |index: usize, expected: &Expected| expected.unknown == Unknown::Effect { index, value: 0 };
    let mut open = open_in(&last.evidence, subject, &all);
    for expected in open.iter_mut().filter(|e| own.iter().any(|&index| is_of(index, e))) {
        *expected = Expected::new(expected.unknown, 0.0, subject.criteria.prior.torque_constant);
    }
    let linear = Linearisation::of(&last.evidence, all, open)?;
    let step = linear.step_within(|unknown| range(unknown, &linear.hypothesis, subject));
    let halves = linear.half_intervals(&last.evidence);
    let estimate = |index: &usize| {
        let place = linear.place_of(Unknown::Effect { index: *index, value: 0 })?;
        let mut constant = linear.hypothesis.effects[*index].clone();
        constant.values[0] += step[place];
        Some(Estimate { constant, half: halves[place] })
    };
    own.iter().map(estimate).collect()
}

/// By what part a torque constant is off.
fn off(constant: &EffectInstance) -> f64 {
    constant.values[0]
}

/// The torque constants that a model holds beside those of the model as given.
fn found(subject: &Subject, model: &Hypothesis) -> Vec<EffectInstance> {
    let effects = model.effects.iter().skip(subject.known_effects.len());
    effects.filter(|effect| effect.is_torque_constant()).cloned().collect()
}

/// A model with the torque constants of all joints in it.
fn with_all(subject: &Subject, model: &Hypothesis, like: &EffectInstance) -> Hypothesis {
    let mut all = model.clone();
    for &joint in &subject.joints {
        let as_given = EffectInstance { joint: joint as u8 + 1, values: vec![0.0], ..like.clone() };
        if !has_place_of(&all.effects[subject.known_effects.len()..], &as_given) {
            all.effects.push(as_given);
        }
    }
    all
}

fn has_place_of(effects: &[EffectInstance], effect: &EffectInstance) -> bool {
    effects.iter().any(|other| other.has_place_of(effect))
}

impl OpenConstants {
    /// The subject with how well those that were found are known.
    pub fn told_to(&self, subject: Subject) -> Subject {
        Subject { found_constants: self.found.clone(), ..subject }
    }

    /// The subject whose model has those in doubt where they are likeliest.
    pub fn taken_for_known(&self, subject: &Subject) -> Subject {
        let mut subject = self.told_to(subject.clone());
        let known = |constant: &EffectInstance| {
            (constant.definition, constant.joint, constant.values.clone())
        };
        subject.known_effects.extend(self.in_doubt.iter().map(known));
        subject
    }

    /// A model with those in doubt among the effects that are known of the subject.
    pub fn known_in(&self, subject: &Subject, model: &Hypothesis) -> Hypothesis {
        let mut model = model.clone();
        let mut others = model.effects.split_off(subject.known_effects.len());
        others.retain(|effect| !has_place_of(&self.in_doubt, effect));
        model.effects.extend(self.in_doubt.iter().cloned().chain(others));
        model
    }

    /// Causes but for those in doubt, for a search by a model that has them.
    pub fn left_out_of(&self, subject: &Subject, causes: KnownCauses) -> KnownCauses {
        let KnownCauses { mut causes, found_in } = causes;
        let is_open = |effect: &EffectInstance| !has_place_of(&self.in_doubt, effect);
        causes.retain(|known| is_open(&known.effect));
        causes.iter_mut().for_each(|known| known.rivals.retain(is_open));
        let found_in = found_in.map(|model| Box::new(self.known_in(subject, &model)));
        KnownCauses { causes, found_in }
    }
}
