//! Which terms each joint's command has beyond Coulomb's level and viscous friction: those that its logs show.
//!
//! Least squares alone decide, without regard to what is physical or was known before; all terms are open at first,
//! and each joint's least sure one is left out until all are sure.

use super::fitting::{Fitting, WeightedRows};
use super::friction_terms::{FrictionTerms, JointTerms, Term};
use super::layout::{Layout, TERMS};
use super::linear::Linear;
use super::settings::Settings;

/// The terms that the logs of joints that move show, loads by the links of the chain that comes with none.
pub fn shown(fitting: &Fitting, without: FrictionTerms, moves: &[bool]) -> FrictionTerms {
    let mut terms = all_open(fitting, &without, moves);
    // Each round closes one term of a joint at least, until none is left to be closed.
    for _ in 0..TERMS {
        let Some(solved) = Solved::of(fitting, &terms) else { return without };
        for joint in 0..terms.joints.len() {
            terms.joints[joint] = solved.without_least_sure(&terms, joint, fitting.settings);
        }
    }
    terms
}

/// All terms on all joints that move, each peak as wide as leaves least.
fn all_open(fitting: &Fitting, without: &FrictionTerms, moves: &[bool]) -> FrictionTerms {
    let fastest = fitting.fastest();
    let of_part = |part: &f64| -> FrictionTerms {
        let of_joint = |(joint, fastest): (usize, &f64)| JointTerms {
            open: Term::ALL.map(|term| moves[joint] && fitting.may_have(joint, term)),
            stribeck_velocity: part * fastest,
        };
        let joints = fastest.iter().enumerate().map(of_joint).collect();
        FrictionTerms { joints, ..without.clone() }
    };
    let tried: Vec<_> = (fitting.settings.stribeck_velocities.iter().map(of_part))
        .filter_map(|terms| Some((Solved::of(fitting, &terms)?, terms)))
        .collect();
    let mut best = without.clone();
    for (joint, terms) in best.joints.iter_mut().enumerate() {
        let least = tried.iter().min_by(|a, b| a.0.squares(joint).total_cmp(&b.0.squares(joint)));
        *terms = least.map_or(*terms, |(_, tried)| tried.joints[joint]);
    }
    best
}

/// Least squares with some terms.
struct Solved {
    layout: Layout,
    weighted: WeightedRows,
    found: Linear,
}

impl Solved {
    fn of(fitting: &Fitting, terms: &FrictionTerms) -> Option<Self> {
        let weighted = fitting.rows(terms);
        let found = Linear::of(&weighted.rows)?;
        Some(Self { layout: Layout { joints: terms.joints.len() }, weighted, found })
    }

    /// Squares that are left of a joint's command.
    fn squares(&self, joint: usize) -> f64 {
        self.weighted.squares(joint, &self.found.numbers)
    }

    /// Squared standard errors by which a term of a joint is above nothing.
    fn surety(&self, joint: usize, term: Term) -> f64 {
        let at = self.layout.own(joint) + term.number();
        let value = self.found.numbers[at];
        let is_possible = value > 0.0 || term.may_be_negative();
        if is_possible { value * value / self.found.variances[at] } else { 0.0 }
    }

    /// A joint's terms without the least sure of those that its logs do not show.
    fn without_least_sure(
        &self,
        terms: &FrictionTerms,
        joint: usize,
        settings: &Settings,
    ) -> JointTerms {
        let mut terms = terms.joints[joint];
        let sure = |index: usize| errors(Term::ALL[index], settings).powi(2);
        let open = (0..TERMS).filter(|index| terms.open[*index]);
        let sureties = open.map(|index| (index, self.surety(joint, Term::ALL[index])));
        let by_sure = |of: &(usize, f64)| of.1 / sure(of.0);
        let least = sureties.min_by(|a, b| by_sure(a).total_cmp(&by_sure(b)));
        let Some((index, squares)) = least else { return terms };
        // What is left has as many squares as there are independent rows.
        let left = self.weighted.weights[joint] * self.squares(joint);
        terms.open[index] =
            squares > sure(index) && squares > settings.term_part * (squares + left);
        terms
    }
}

/// How many standard errors show a term.
fn errors(term: Term, settings: &Settings) -> f64 {
    match term {
        Term::Constant => settings.constant_errors,
        Term::Peak | Term::Load | Term::Square => settings.term_errors,
    }
}
