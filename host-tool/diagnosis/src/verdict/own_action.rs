//! What a cause does itself on the confirming logs, and what goes with it.

use super::blocks::Blocks;
use super::confirmed::Confirmation;
use super::decision::ProbabilityOfCause;
use super::judged::Judged;
use super::worth::{Worth, does_it_itself};
use crate::criteria::VerdictCriteria;
use crate::fit::fitted_model::FittedModel;
use crate::rows::evidence::Rows;
use crate::trial::residual_rows::residual_rows_as_warm_as;

impl Confirmation<'_> {
    /// What the cause at this place among those added amounts to, its probability as `probability` says of
    /// its worth.
    ///
    /// Its share is what goes when it comes into a model that is fitted without it. Where it hardly acts,
    /// parameters do that, which train logs had bent where something acts: a limit, say, that few commands of
    /// confirming logs come near to. There it is judged by what it does itself, unless it is nearly sure that much goes
    /// with it, and its share may be as small as its own doing.
    pub fn judged(
        &self,
        last: &FittedModel,
        index: usize,
        probability: impl Fn(&Worth) -> ProbabilityOfCause,
    ) -> Judged {
        let place = self.subject.known_effects.len() + index;
        let effect = &last.linear.hypothesis.effects[place];
        let (without_v, with_v) = (&self.without[index].residual_v, &self.full.residual_v);
        let joints = self.joints_judged(last, effect, [without_v, with_v]);
        let dropped_v = self.left_without(last, place);
        let of = |left_v: &Rows| {
            let told = self.worth_on(last, &joints, left_v, with_v);
            (told, self.weighed_worth(last, &joints, left_v, told))
        };
        let (all, weighed) = of(without_v);
        let judged = |worth, judged_by, counts_in_full| {
            let ProbabilityOfCause { of_any: probability, by_name } = probability(&judged_by);
            let share_with_it = weighed.share;
            Judged {
                worth,
                weighed: judged_by,
                probability,
                by_name,
                counts_in_full,
                share_with_it,
            }
        };
        if self.acts(last, &joints, without_v, &dropped_v) {
            return judged(all, weighed, true);
        }
        let (own, own_weighed) = of(&dropped_v);
        let worth = all.in_any_order(Some(&own));
        match goes_surely(probability(&weighed).of_any, &weighed, &self.subject.criteria.verdict) {
            true => judged(worth, weighed, true),
            false => judged(worth, own_weighed, false),
        }
    }

    /// What the model leaves if the effect at this place is dropped and all else unchanged [V].
    fn left_without(&self, last: &FittedModel, place: usize) -> Rows {
        let full = &self.full.linear.hypothesis;
        let mut hypothesis = full.clone();
        hypothesis.effects.remove(place);
        last.evidence.volts(&residual_rows_as_warm_as(&last.evidence, &hypothesis, full))
    }

    /// Whether a cause acts on the confirming logs: what it does there itself is a part of what goes with it
    /// (`least_action`), or stands out of the noise (`no_gap_ratio`).
    fn acts(
        &self,
        last: &FittedModel,
        joints: &[usize],
        without_v: &Rows,
        dropped_v: &Rows,
    ) -> bool {
        let with_v = &self.full.residual_v;
        let action_v = difference(dropped_v, with_v);
        let noise_v = |joint: usize, s: usize| self.noise_v[joint][s];
        let models = [without_v, with_v, &action_v];
        let blocks = Blocks::of(&last.evidence, joints, &models, noise_v);
        does_it_itself(&blocks, &self.subject.criteria.verdict)
    }
}

/// Whether it is nearly sure that much of the gap goes with a cause, whatever does it.
fn goes_surely(probability: f64, worth: &Worth, criteria: &VerdictCriteria) -> bool {
    probability >= criteria.sure_of_idle && worth.share >= criteria.most_with_idle
}

/// Rows less others.
fn difference(rows: &Rows, others: &Rows) -> Rows {
    let of_joint = |(a, b): (&Vec<f64>, &Vec<f64>)| a.iter().zip(b).map(|(a, b)| a - b).collect();
    rows.iter().zip(others).map(of_joint).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Criteria;

    /// Limits of seven-axis arms that have none: 0.98 likely, with a ninth of the gap at most.
    #[test]
    fn what_hardly_acts_counts_by_all_that_goes_with_it_where_that_is_much_and_sure() {
        let criteria = Criteria::default().verdict;
        let blocks = |without_v2: f64| Blocks::made(vec![vec![without_v2, 2.0, 10.0, 1.0]; 4]);
        let surely = |probability: f64, without_v2: f64| {
            goes_surely(probability, &Worth::of(&blocks(without_v2), &criteria), &criteria)
        };
        assert!(surely(0.98, 6.0));
        assert!(surely(0.98, 4.0), "two ninths");
        assert!(!surely(0.9, 6.0), "not sure");
        assert!(!surely(0.98, 3.0), "a ninth");
    }
}
