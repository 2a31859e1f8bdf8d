//! How many answers are right, kind by kind.

use serde::Serialize;

use crate::case::Kind;
use crate::outcome::Outcome;
use diagnosis::{Alternative, Verdict};

/// So many of so many.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Share {
    /// So many.
    pub count: usize,
    /// Of so many.
    pub of: usize,
}

impl Share {
    /// How many outcomes have a property.
    pub fn among<'a>(
        outcomes: impl IntoIterator<Item = &'a Outcome>,
        has: impl Fn(&Outcome) -> bool,
    ) -> Self {
        outcomes.into_iter().fold(Self::default(), |share, outcome| share.with(has(outcome)))
    }

    /// One more.
    pub fn with(self, has: bool) -> Self {
        Self { count: self.count + usize::from(has), of: self.of + 1 }
    }

    /// The part; `None` of nothing.
    pub fn part(self) -> Option<f64> {
        (self.of > 0).then(|| self.count as f64 / self.of as f64)
    }

    /// Wilson's 95 % interval of the part.
    pub fn interval(self) -> Option<[f64; 2]> {
        const Z: f64 = 1.959_964;
        let (part, n) = (self.part()?, self.of as f64);
        let centre = (part + 0.5 * Z * Z / n) / (1.0 + Z * Z / n);
        let half =
            Z / (1.0 + Z * Z / n) * (part * (1.0 - part) / n + 0.25 * (Z / n).powi(2)).sqrt();
        Some([(centre - half).max(0.0), (centre + half).min(1.0)])
    }
}

fn of_kind(outcomes: &[Outcome], kind: Kind) -> Vec<&Outcome> {
    outcomes.iter().filter(|outcome| outcome.kind == kind).collect()
}

fn count(outcomes: &[&Outcome], has: impl Fn(&Outcome) -> bool) -> Share {
    Share::among(outcomes.iter().copied(), has)
}

/// Cases of one effect.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Singles {
    /// The first cause named is the true one, on its joint.
    pub right: Share,
    /// And no other is named.
    pub right_alone: Share,
    /// The first cause named is the true effect, on any joint.
    pub effect_right: Share,
    /// Another is named first, but the truth is named as well or not ruled out.
    pub not_ruled_out: Share,
    /// The answer is "none".
    pub missed: Share,
    /// The answer is "unknown".
    pub unknown: Share,
}

impl Singles {
    pub(super) fn of(outcomes: &[Outcome]) -> Self {
        let singles = of_kind(outcomes, Kind::Single);
        let effect = |outcome: &Outcome| {
            outcome.truth.first().is_some_and(|truth| truth.effect == outcome.answer.label())
        };
        Self {
            right: count(&singles, first_is_true),
            right_alone: count(&singles, Outcome::is_right),
            effect_right: count(&singles, effect),
            not_ruled_out: count(&singles, |outcome| {
                !first_is_true(outcome) && (outcome.found() > 0 || is_alternative(outcome))
            }),
            missed: count(&singles, |outcome| outcome.answer.label() == "none"),
            unknown: count(&singles, |outcome| outcome.answer.label() == "unknown"),
        }
    }
}

fn first_is_true(outcome: &Outcome) -> bool {
    outcome.answer.named().first().is_some_and(|cause| outcome.is_true(cause))
}

/// Whether a true cause stands among the alternatives.
fn is_alternative(outcome: &Outcome) -> bool {
    let alternatives = outcome.answer.report().map_or(&[][..], |report| &report.alternatives);
    let is_true = |a: &Alternative| {
        outcome.truth.iter().any(|truth| truth.effect == a.effect && truth.joint == a.joint)
    };
    alternatives.iter().any(is_true)
}

/// Cases of two effects.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Pairs {
    /// Both are named, in any order.
    pub both: Share,
    /// And no other.
    pub both_alone: Share,
    /// One of them is named.
    pub one: Share,
    /// A cause is named that is not true.
    pub wrong_name: Share,
}

impl Pairs {
    pub(super) fn of(outcomes: &[Outcome]) -> Self {
        let pairs = of_kind(outcomes, Kind::Pair);
        let wrong =
            |outcome: &Outcome| outcome.answer.named().iter().any(|cause| !outcome.is_true(cause));
        Self {
            both: count(&pairs, |outcome| outcome.found() == 2),
            both_alone: count(&pairs, Outcome::is_right),
            one: count(&pairs, |outcome| outcome.found() == 1),
            wrong_name: count(&pairs, wrong),
        }
    }
}

/// Cases with nothing hidden.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct NoEffect {
    /// The answer is "none".
    pub right: Share,
    /// A cause is named.
    pub false_alarms: Share,
    /// The answer is "unknown".
    pub unknown: Share,
}

impl NoEffect {
    pub(super) fn of(outcomes: &[Outcome]) -> Self {
        let cases = of_kind(outcomes, Kind::None);
        Self {
            right: count(&cases, Outcome::is_right),
            false_alarms: count(&cases, |outcome| !outcome.answer.named().is_empty()),
            unknown: count(&cases, |outcome| outcome.answer.label() == "unknown"),
        }
    }
}

/// Cases of an effect that the catalogue does not have.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Foreign {
    /// The answer is "unknown".
    pub unknown: Share,
    /// A cause of the catalogue is named.
    pub wrong_name: Share,
    /// The answer is "none".
    pub missed: Share,
}

impl Foreign {
    pub(super) fn of(outcomes: &[Outcome]) -> Self {
        let cases = of_kind(outcomes, Kind::Foreign);
        Self {
            unknown: count(&cases, Outcome::is_right),
            wrong_name: count(&cases, |outcome| !outcome.answer.named().is_empty()),
            missed: count(&cases, |outcome| outcome.answer.label() == "none"),
        }
    }
}

/// Whether the joint is right, where one cause acts on one joint.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Joints {
    /// Of the first cause, in cases of one effect for which a cause is named.
    pub named: Share,
    /// Of the first entry of `where`, foreign effects included, where there is one.
    pub largest_place: Share,
}

impl Joints {
    pub(super) fn of(outcomes: &[Outcome]) -> Self {
        let (mut named, mut largest_place) = (Share::default(), Share::default());
        for outcome in outcomes {
            let [truth] = &outcome.truth[..] else { continue };
            if truth.joint == 0 {
                continue;
            }
            if let (Kind::Single, [first, ..]) = (outcome.kind, outcome.answer.named()) {
                named = named.with(first.joint == truth.joint);
            }
            let gap = outcome.answer.report().filter(|report| report.verdict != Verdict::None);
            if let Some(place) = gap.and_then(|report| report.gap_shares.first()) {
                largest_place = largest_place.with(place.joint == truth.joint);
            }
        }
        Self { named, largest_place }
    }
}
