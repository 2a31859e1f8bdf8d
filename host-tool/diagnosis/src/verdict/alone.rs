//! What a cause may be worth beside its share: causes that overlap share what they take by the order in
//! which they are added, and a part of what is left is theirs, which their true parameters would take.

use rayon::prelude::*;

use super::confirmed::Confirmation;
use super::held::Held;
use super::worth::Worth;
use crate::fit::fitted_model::FittedModel;
use crate::trial::hypothesis::{EffectInstance, Hypothesis};

impl Worth {
    /// The same with an interval that holds the share of the cause whether it is added first or last:
    /// the hull of both, between nothing and all.
    pub fn in_any_order(self, first: Option<&Self>) -> Self {
        let [from, to] = self.share_interval;
        let [first_from, first_to] =
            first.map_or(self.share_interval, |first| first.share_interval);
        let hull = [from.min(first_from), to.max(first_to)];
        Self { share_interval: hull.map(|side| side.clamp(0.0, 1.0)), ..self }
    }

    /// The same with an interval up to what the cause would take besides if all that is left went to the causes
    /// as what they take does, once more at most: by its true parameters a cause takes most, by an estimate
    /// of them less.
    pub fn with_remainder(self) -> Self {
        let taken = (1.0 - self.remainder).max(0.5);
        let besides = self.share.max(0.0) * self.remainder / taken;
        let [from, to] = self.share_interval;
        Self { share_interval: [from, (to + besides).min(1.0)], ..self }
    }

    /// The same with an interval, from nothing on, that is wider at either end by a part of that end: a model that
    /// lacks another of the small effects that are there, or has one more, shares the gap out a little differently.
    pub fn within_part(self, part: f64) -> Self {
        let [from, to] = self.share_interval;
        let wider = [(1.0 - part) * from, ((1.0 + part) * to).min(1.0)];
        Self { share_interval: wider, ..self }
    }
}

impl Confirmation<'_> {
    /// The worth of an effect of the model `last` that is added to the refitted one before all others.
    /// `None` where that cannot be fitted.
    pub fn worth_added_first(
        &self,
        refitted: &FittedModel,
        last: &FittedModel,
        effect: &EffectInstance,
    ) -> Option<Worth> {
        let with = Held::of(self.subject, &self.alone(refitted, last, effect)?);
        Some(self.worth_of(last, effect, &self.refitted.residual_v, &with.residual_v))
    }

    /// The model with one effect alone: the best of fits that begin with the parameters of the model without any, by its
    /// slopes and by their own, and with those of the model with all. Far from linear, play say, it takes much only
    /// where parameters make room for it.
    fn alone(
        &self,
        refitted: &FittedModel,
        last: &FittedModel,
        effect: &EffectInstance,
    ) -> Option<FittedModel> {
        let (FittedModel { linear, evidence, .. }, subject) = (refitted, self.subject);
        let steps = subject.criteria.selection.accepted_steps;
        let from_refitted = linear.hypothesis.with(effect.clone());
        let from_last =
            Hypothesis { effects: from_refitted.effects.clone(), ..last.linear.hypothesis.clone() };
        let near =
            FittedModel::fitted_near(linear, evidence, subject, from_refitted.clone(), steps);
        let anew = [from_refitted, from_last].into_par_iter().filter_map(|start| {
            Some(FittedModel::fitted(evidence, subject, start, steps)?.settled(subject))
        });
        let anew: Vec<FittedModel> = anew.collect();
        near.into_iter().chain(anew).reduce(FittedModel::better_of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn worth(share: f64, share_interval: [f64; 2]) -> Worth {
        Worth {
            share,
            share_interval,
            remainder: 0.1,
            part_of_left: share,
            shrinkage: 0.1,
            shrinkage_interval: [0.05, 0.2],
        }
    }

    #[test]
    fn an_interval_holds_the_share_of_either_order() {
        let (last, first) = (worth(0.3, [0.2, 0.4]), worth(0.6, [0.5, 0.7]));
        let both = last.in_any_order(Some(&first));
        assert_eq!((both.share, both.share_interval), (0.3, [0.2, 0.7]));
        assert_eq!(last.in_any_order(None).share_interval, [0.2, 0.4]);
        let harmful = last.in_any_order(Some(&worth(-1.0, [-2.0, 0.1])));
        assert_eq!(harmful.share_interval, [0.0, 0.4]);
    }

    #[test]
    fn an_interval_is_wider_by_a_part_of_its_ends_and_ends_with_all_of_the_gap() {
        assert_eq!(worth(0.3, [0.25, 0.5]).within_part(0.5).share_interval, [0.125, 0.75]);
        assert_eq!(worth(0.9, [0.0, 0.95]).within_part(0.15).share_interval, [0.0, 1.0]);
    }

    #[test]
    fn an_interval_holds_what_may_be_left_of_the_cause() {
        let of_remainder = |remainder| Worth { remainder, ..worth(0.45, [0.4, 0.5]) };
        let upper = |remainder| of_remainder(remainder).with_remainder().share_interval[1];
        assert_eq!(of_remainder(0.0).with_remainder(), of_remainder(0.0));
        assert!((upper(0.1) - 0.55).abs() < 1e-12, "{}", upper(0.1));
        assert!((upper(0.5) - 0.95).abs() < 1e-12, "{}", upper(0.5));
        assert_eq!(upper(1.0), 1.0);
    }
}
