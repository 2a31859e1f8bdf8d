//! How well the answers fit.

use serde::Serialize;

use super::outcome::ArmOutcome;
use crate::case::Kind;
use crate::score::Share;

/// Counts of a trial.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct ArmScore {
    /// Of causes that could be known: named first, on the right joint.
    pub knowable_first: Share,
    /// Of causes that could not be known: named first all the same.
    pub beyond_knowable: Share,
    /// Cases with a wrong name, of all.
    pub wrong_name: Share,
    /// Of arms without anything hidden: the verdict is "none".
    pub clean_none: Share,
    /// No report.
    pub failed: Share,
}

impl ArmScore {
    /// Of all cases.
    pub fn of(outcomes: &[ArmOutcome]) -> Self {
        let count = |is_in: &dyn Fn(&ArmOutcome) -> bool, has: &dyn Fn(&ArmOutcome) -> bool| {
            let cases = outcomes.iter().filter(|outcome| is_in(outcome));
            cases.fold(Share::default(), |share, outcome| share.with(has(outcome)))
        };
        let hidden = |outcome: &ArmOutcome| outcome.kind != Kind::None;
        let first = ArmOutcome::is_first_right;
        Self {
            knowable_first: count(&|o| hidden(o) && o.is_knowable(), &first),
            beyond_knowable: count(&|o| hidden(o) && !o.is_knowable(), &first),
            wrong_name: count(&|_| true, &ArmOutcome::has_wrong_name),
            clean_none: count(&|o| !hidden(o), &ArmOutcome::is_none),
            failed: count(&|_| true, &|o| o.failure.is_some()),
        }
    }
}
