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
    // Each round but the last closes a term of a joint at least.
    for _ in 0..=TERMS * terms.joints.len() {
        let Some(solved) = Solved::of(fitting, &terms) else { return without };
        let joints: Vec<JointTerms> = (0..terms.joints.len())
            .map(|joint| solved.without_least_sure(&terms, joint, fitting.settings))
            .collect();
        if joints == terms.joints {
            break;
        }
        terms.joints = joints;
    }
    terms
}

/// All terms on all joints that move, each peak as wide as leaves least; none where all that are tried are narrower than
/// what a joint's rows see.
fn all_open(fitting: &Fitting, without: &FrictionTerms, moves: &[bool]) -> FrictionTerms {
    let (fastest, slowest) = (fitting.fastest(), fitting.slowest());
    let of_part = |part: &f64| -> FrictionTerms {
        let of_joint = |joint: usize| {
            let stribeck_velocity = part * fastest[joint];
            let may_have = |term: Term| match term {
                Term::Peak => fitting.seeks_peak(joint) && stribeck_velocity >= slowest[joint],
                Term::Load | Term::Square | Term::Constant => true,
            };
            let open = Term::ALL.map(|term| moves[joint] && may_have(term));
            JointTerms { open, stribeck_velocity }
        };
        let joints = (0..fastest.len()).map(of_joint).collect();
        FrictionTerms { joints, ..without.clone() }
    };
    let tried: Vec<(FrictionTerms, Vec<f64>)> =
        (fitting.settings.stribeck_velocities.iter().map(of_part))
            .filter_map(|terms| {
                let solved = Solved::of(fitting, &terms)?;
                let squares = (0..fastest.len()).map(|joint| solved.squares(joint)).collect();
                Some((terms, squares))
            })
            .collect();
    let mut best = without.clone();
    for (joint, terms) in best.joints.iter_mut().enumerate() {
        let least = tried.iter().min_by(|a, b| a.1[joint].total_cmp(&b.1[joint]));
        *terms = least.map_or(*terms, |(tried, _)| tried.joints[joint]);
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

    /// Squared t value of a term of a joint, by how many standard errors it is not nothing.
    fn t_squared(&self, joint: usize, term: Term) -> f64 {
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
        let values = open.map(|index| (index, self.t_squared(joint, Term::ALL[index])));
        let by_sure = |of: &(usize, f64)| of.1 / sure(of.0);
        let least = values.min_by(|a, b| by_sure(a).total_cmp(&by_sure(b)));
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
