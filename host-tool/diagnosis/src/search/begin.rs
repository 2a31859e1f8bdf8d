//! Where a search begins that knows effects already: from one by another doubt about the model or with parameters all
//! but free, or as what a fault of the model comes to.

use super::found::{Known, KnownCauses};
use super::independent_rows::fitted_by_independent_rows;
use super::objection::objection_to;
use super::policy::is_physical;
use super::selection::Search;
use crate::fit::fitted_model::FittedModel;
use crate::trial::hypothesis::{EffectInstance, Hypothesis};

impl Search<'_> {
    /// Adds all effects that are known, with the values that they are known by, and takes out those that do not
    /// pay beside the others, those that gain least first: several may pay only together.
    pub(super) fn begin_with(&mut self, known: KnownCauses) {
        let KnownCauses { mut causes, found_in } = known;
        causes.sort_by(|a, b| a.gain.total_cmp(&b.gain));
        let most = self.subject.criteria.selection.most_effects;
        causes.drain(..causes.len().saturating_sub(most));
        let Some(with) = self.physical_together(&mut causes, found_in.as_deref()) else { return };
        let before = std::mem::replace(&mut self.last, with);
        self.rivals = causes.into_iter().map(|known| known.rivals).collect();
        self.prune(0);
        let without = self.best_without_effects(before);
        let effects = &self.last.linear.hypothesis.effects;
        let alone = effects.last().filter(|_| self.rivals.len() == 1);
        if objection_to(alone, &without, &self.last, &self.subject.criteria).is_some() {
            (self.last, self.rivals) = (without, Vec::new());
        }
    }

    /// The better of the model without effects and the one with them, refitted without: what another start alone
    /// gains is no effect's.
    fn best_without_effects(&self, before: FittedModel) -> FittedModel {
        let own = self.subject.known_effects.len();
        let mut hypothesis = self.last.linear.hypothesis.clone();
        hypothesis.effects.truncate(own);
        let again = self.fitted(hypothesis).map(|again| again.settled(self.subject));
        again.into_iter().fold(before, FittedModel::better_of)
    }

    /// The model with all these effects that are physical in it; the others leave the list.
    fn physical_together(
        &self,
        causes: &mut Vec<Known>,
        found_in: Option<&Hypothesis>,
    ) -> Option<FittedModel> {
        let with = self.together(causes, found_in)?;
        let effects = &with.linear.hypothesis.effects[self.subject.known_effects.len()..];
        let is_physical =
            |effect: &EffectInstance| is_physical(effect, self.subject, &with.evidence);
        let physical: Vec<bool> = effects.iter().map(is_physical).collect();
        if !physical.contains(&false) {
            return Some(with);
        }
        let mut stays = physical.into_iter();
        causes.retain(|_| stays.next().unwrap_or(false));
        self.together(causes, found_in)
    }

    /// The model with all these effects, fitted to its end; none without effects. It begins from the refitted
    /// model and from the one that they were found in: what a missing cause bends in the first, friction about
    /// standstill say, a few steps do not bring back.
    fn together(&self, causes: &[Known], found_in: Option<&Hypothesis>) -> Option<FittedModel> {
        if causes.is_empty() {
            return None;
        }
        let own = self.subject.known_effects.len();
        let with_effects = |model: &Hypothesis| {
            let mut model = model.clone();
            let found = model.effects.split_off(own);
            let known = causes.iter().map(|known| &known.effect);
            model.effects.extend(known.map(|known| known.as_in(&found).clone()));
            model.with_room(own)
        };
        let near = self.fitted(with_effects(&self.last.linear.hypothesis));
        let steps = self.subject.criteria.selection.accepted_steps;
        let anew = found_in.and_then(|model| {
            FittedModel::fitted(&self.last.evidence, self.subject, with_effects(model), steps)
        });
        let with =
            near.into_iter().chain(anew).reduce(FittedModel::better_of)?.settled(self.subject);
        let anew = fitted_by_independent_rows(self.subject, &with, steps);
        Some(anew.into_iter().fold(with, FittedModel::better_of))
    }
}
