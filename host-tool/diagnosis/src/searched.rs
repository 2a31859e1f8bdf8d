//! What a search finds by one doubt about the model, and what its logs say of that doubt.

use std::cell::Cell;

use crate::criteria::Doubt;
use crate::fit::command_instants::{Prepared, by_instants, early_part, prepared_by_instants};
use crate::fit::doubt;
use crate::fit::fitted_model::FittedModel;
use crate::fit::preparation::prepared;
use crate::logs::stretch::Stretch;
use crate::logs::subject::Subject;
use crate::model_faults::{Faults, FoundFault};
use crate::rows::evidence::Evidence;
use crate::search::found::{KnownCauses, Selection};
use crate::search::selection::select;
use crate::trial::hypothesis::Hypothesis;
use recordings::StepError;

/// What a search finds by one doubt about the model.
pub struct Searched {
    /// The rows.
    pub evidence: Evidence,
    /// The effects that were added.
    pub selection: Selection,
    /// A fault of the model itself.
    pub fault: Option<FoundFault>,
    /// By what part of a sample period commands act before the intervals of their rows.
    pub early_part: f64,
}

/// What shows once the model's parameters are all but free.
pub enum Free {
    /// They are further off than was thought: the doubt by which the logs are likeliest, and the causes that tell it.
    Doubt(Doubt, KnownCauses),
    /// They are not, but held they had hidden causes: a search begun with those.
    Causes(Box<Searched>),
}

impl Searched {
    /// Searches stretches of logs, beginning with effects that are known; the refit starts from the model as given
    /// and, where there is one, from a model `near` by. Commands may be those of instants unless that is settled.
    ///
    /// # Errors
    /// Logs that leave no rows.
    pub fn of(
        subject: &Subject,
        stretches: Vec<Stretch>,
        near: Option<&Hypothesis>,
        known: KnownCauses,
        may_be_early: bool,
        progress: &dyn Fn(&str),
    ) -> Result<Self, StepError> {
        progress("refitting the model");
        let first = if may_be_early {
            prepared_by_instants(subject, stretches.clone(), near)?
        } else {
            let (evidence, refitted) = prepared(subject, stretches.clone(), near)?;
            (evidence, refitted, 0.0)
        };
        if !may_be_early || first.2 > 0.0 {
            return Ok(Self::of_prepared(subject, first, known, &|_| false, progress));
        }
        Ok(Self::looking_for_instants(subject, (stretches, near), first, known, progress))
    }

    /// Searches rows whose commands may yet be those of instants, which a large cause that is missing may hide: once the
    /// causes found show it, on rows shifted so; or on the same again, where that mends nothing.
    fn looking_for_instants(
        subject: &Subject,
        logs: (Vec<Stretch>, Option<&Hypothesis>),
        first: Prepared,
        known: KnownCauses,
        progress: &dyn Fn(&str),
    ) -> Self {
        let is_cut_short = Cell::new(false);
        let seems_early = |last: &FittedModel| {
            let seems_early = early_part(subject, last) > 0.0;
            is_cut_short.set(is_cut_short.get() || seems_early);
            seems_early
        };
        let found = Self::of_prepared(subject, first.clone(), known, &seems_early, progress);
        if !is_cut_short.get() {
            return found;
        }
        let shifted = found.shifted(subject, logs, progress);
        shifted.unwrap_or_else(|| found.again(subject, first, progress))
    }

    /// A search that begins with the causes of this one, on rows whose commands act earlier by what its last model says;
    /// none where they seem to be early then, too.
    fn shifted(
        &self,
        subject: &Subject,
        (stretches, near): (Vec<Stretch>, Option<&Hypothesis>),
        progress: &dyn Fn(&str),
    ) -> Option<Self> {
        let part_of = |search: &Self| early_part(subject, &search.selection.last.by_all_rows());
        let part = part_of(self);
        if part == 0.0 {
            return None;
        }
        let (evidence, refitted) = prepared(subject, by_instants(stretches, part), near).ok()?;
        let shifted = self.again(subject, (evidence, refitted, part), progress);
        (part_of(&shifted) == 0.0).then_some(shifted)
    }

    /// A search of other rows that begins with the causes of this one.
    fn again(&self, subject: &Subject, prepared: Prepared, progress: &dyn Fn(&str)) -> Self {
        let known = self.selection.known(subject);
        Self::of_prepared(subject, prepared, known, &|_| false, progress)
    }

    /// Searches rows and the model refitted to them until nothing is left that asks for it, or what is found shows that
    /// commands are early; faults of the model are told by rows whose commands are not.
    fn of_prepared(
        subject: &Subject,
        (evidence, refitted, early_part): Prepared,
        known: KnownCauses,
        seems_early: &dyn Fn(&FittedModel) -> bool,
        progress: &dyn Fn(&str),
    ) -> Self {
        let faults = Faults::of(subject, &evidence);
        let explains_all = |refitted: &FittedModel, last: &FittedModel| {
            faults.is_sure(refitted, last) || seems_early(last)
        };
        let selection = select(subject, refitted, known, &explains_all, progress);
        if seems_early(&selection.last) {
            return Self { evidence, selection, fault: None, early_part };
        }
        progress("trying whether the model itself is at fault");
        let found = faults.found(&selection.refitted, &selection.last);
        let explains_all = |last: &FittedModel| faults.leaves_hardly_any(&selection.refitted, last);
        let said = found.as_ref().and_then(|found| {
            as_causes(subject, &selection.refitted, found, &explains_all, progress)
        });
        let (selection, fault) = match (said, found) {
            (Some(said), _) => (said, None),
            (None, Some(found)) => (selection.without_effects(), Some(found)),
            (None, None) => (selection, None),
        };
        Self { evidence, selection, fault, early_part }
    }

    /// A wider doubt, or a search begun with causes that held parameters had hidden. The causes found tell the doubt where
    /// free parameters explain more with them. Else, where much is left, a search with free parameters comes first; a doubt
    /// by which the logs are only likelier comes last.
    pub fn with_free_parameters(
        &self,
        subject: &Subject,
        stretches: &[Stretch],
        progress: &dyn Fn(&str),
    ) -> Option<Free> {
        if self.fault.is_some() {
            return None;
        }
        let last = &self.selection.last.by_all_rows();
        let wider = doubt::wider(subject, last);
        let explains_more = wider.as_ref().is_some_and(|wider| wider.explains_more);
        if !explains_more && last.stats.worst() > subject.criteria.prior.much_left {
            let wide = self.wide(subject, stretches, progress);
            if wide.as_ref().is_some_and(|wide| wide.fault.is_some()) {
                return None;
            }
            if let Some(wide) = wide.filter(|wide| wide.explains_more(last)) {
                return self.by_wide_search(wide, subject, last, progress);
            }
        }
        wider.map(|wider| Free::Doubt(wider.doubt, self.selection.known(subject)))
    }

    /// A search with all parameters nearly free.
    fn wide(
        &self,
        subject: &Subject,
        stretches: &[Stretch],
        progress: &dyn Fn(&str),
    ) -> Option<Self> {
        let mut free = subject.clone();
        free.doubt(subject.criteria.prior.widest_doubt());
        let near = Some(&self.selection.refitted.linear.hypothesis);
        let suspected = KnownCauses::suspected_of(&free);
        Self::of(&free, stretches.to_vec(), near, suspected, false, progress).ok()
    }

    /// Whether causes were found and their model gains over the one that another search ended with.
    fn explains_more(&self, last: &FittedModel) -> bool {
        let model = self.selection.last.by_all_rows();
        let least = model.evidence.criteria.prior.least_gain;
        !self.selection.added.is_empty() && model.gain_over(last) > least
    }

    /// What a `wide` search shows that explains more than this one, whose last model is `last`.
    fn by_wide_search(
        &self,
        wide: Self,
        subject: &Subject,
        last: &FittedModel,
        progress: &dyn Fn(&str),
    ) -> Option<Free> {
        if let Some(doubt) = doubt::seen(subject, &wide.selection.last.by_all_rows()) {
            return Some(Free::Doubt(doubt, wide.selection.known(subject)));
        }
        let searched = self.with_causes_of(wide, subject, last, progress)?;
        Some(Free::Causes(Box::new(searched)))
    }

    /// The same search begun with the causes that it found and those of a `wide` one, by the doubt that there is; none
    /// where the model with them does not gain over its own, `last`.
    fn with_causes_of(
        &self,
        wide: Self,
        subject: &Subject,
        last: &FittedModel,
        progress: &dyn Fn(&str),
    ) -> Option<Self> {
        let known = self.selection.known(subject).and(wide.selection.known(subject));
        let refitted = self.selection.refitted.clone();
        let selection = select(subject, refitted, known, &|_, _| false, progress);
        let gain = selection.last.by_all_rows().gain_over(last);
        (gain > subject.criteria.prior.least_gain).then(|| Self {
            evidence: self.evidence.clone(),
            selection,
            fault: None,
            early_part: self.early_part,
        })
    }
}

/// A search begun anew with the effects that say the same as a fault of the model; none unless all are accepted, or those
/// that are explain all: of the zeros of all joints, found together, some may not matter.
fn as_causes(
    subject: &Subject,
    refitted: &FittedModel,
    found: &FoundFault,
    explains_all: &dyn Fn(&FittedModel) -> bool,
    progress: &dyn Fn(&str),
) -> Option<Selection> {
    let effects = found.fault.as_effects(subject);
    if effects.is_empty() {
        return None;
    }
    let known = KnownCauses::alone(&effects);
    let said = select(subject, refitted.clone(), known, &|_, _| false, progress);
    let is_accepted = said.holds(&effects) || said.holds_one(&effects) && explains_all(&said.last);
    is_accepted.then_some(said)
}
