//! The causes that are named, with what they are worth, and what else was tried.

use super::confirmed::Confirmation;
use super::elimination::Elimination;
use super::judged::{Judged, Withheld};
use super::worth::Worth;
use crate::fit::fitted_model::FittedModel;
use crate::logs::subject::Subject;
use crate::search::found::{Added, Rival, Selection};

/// What the search amounts to.
pub struct Judgement<'a> {
    /// The refitted model.
    pub refitted: FittedModel,
    /// The model with the causes that are named, and no others.
    pub last: FittedModel,
    /// The causes, in the order of the model's.
    pub named: Vec<Named>,
    /// Effects that were added by the search but are not named.
    pub withheld: Vec<Withheld>,
    /// Candidates that were not accepted at the end.
    pub refused: Vec<Rival>,
    /// The models on the confirming logs.
    pub confirmation: Confirmation<'a>,
}

/// A cause that is named.
pub struct Named {
    /// What the search knows of it.
    pub added: Added,
    /// What it is worth on the confirming logs.
    pub worth: Worth,
    /// Probability that it is a cause, by this name.
    pub probability: f64,
    /// The same by this name or by another that says the same.
    pub of_any: f64,
}

impl<'a> Judgement<'a> {
    /// Judges a selection; `noise_v` is that of rows, rms by joint and stretch [V].
    ///
    /// Effects that are not confirmed are taken out one after the other, the smallest first. Those that
    /// are likely but too small to be named stay until the others are judged, which would have to
    /// explain what they explain; they go one after the other, too. A cause that is told beside those is not
    /// judged anew without them, for they are there, likely.
    pub fn of(subject: &'a Subject, selection: Selection, noise_v: &[Vec<f64>]) -> Self {
        let mut model = Elimination::of(subject, selection, noise_v);
        let (mut confirmation, mut judged) = model.judged();
        while let Some((index, reason)) = model.unlikely(&confirmation, &judged) {
            if !model.take_out(index, judged[index], reason) {
                break;
            }
            (confirmation, judged) = model.judged();
        }
        judged = model.take_out_small(&confirmation, judged);
        let confirmation = model.confirmation();
        let Elimination { refitted, last, added, refused, withheld, .. } = model;
        let named = added.into_iter().zip(judged).map(Named::of).collect();
        let mut judgement = Self { refitted, last, named, withheld, refused, confirmation };
        judgement.widen_shares(subject.known_effects.len());
        judgement
    }

    /// A part of what is left is the causes', and shares of several depend on the order in which they are
    /// added; `known` effects are the model's own.
    fn widen_shares(&mut self, known: usize) {
        let share_error = self.confirmation.subject.criteria.verdict.share_error;
        let several = self.named.len() > 1;
        let effects = &self.last.linear.hypothesis.effects[known..];
        for (named, effect) in self.named.iter_mut().zip(effects) {
            let added_first =
                || self.confirmation.worth_added_first(&self.refitted, &self.last, effect);
            let first = several.then(added_first).flatten();
            let worth = named.worth.with_remainder().in_any_order(first.as_ref());
            named.worth = worth.within_part(share_error);
        }
    }
}

impl Named {
    fn of((added, judged): (Added, Judged)) -> Self {
        let Judged { worth, probability, by_name, .. } = judged;
        Self { added, worth, probability: by_name, of_any: probability }
    }
}
