//! Which fault explains a gap best, if one does.

use nalgebra::DVector;

use super::fault::{ModelFault, lengths_m};
use crate::fit::fitted_model::FittedModel;
use crate::fit::gauss_newton::{fit, fit_with_slopes, open_in};
use crate::fit::linearisation::Linearisation;
use crate::fit::preparation::as_given;
use crate::logs::stretch::Stretch;
use crate::logs::subject::Subject;
use crate::rows::evidence::{Evidence, RowChange, Rows};
use crate::trial::hypothesis::Hypothesis;
use crate::trial::residual_rows::train_residual_rows;
use crate::verdict::misfit::leaves_much;
use rig::plant::Body;

/// A fault that explains the gap.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundFault {
    /// What is wrong.
    pub fault: ModelFault,
    /// Part of the squares above the noise that goes when it is put right.
    pub explained: f64,
}

/// The fault that explains nearly all that the refitted model leaves, and no less than the model
/// with all causes does; none where the model as given is not far off, or where a few causes leave
/// noise alone.
pub fn find(
    subject: &Subject,
    evidence: &Evidence,
    refitted: &FittedModel,
    last: &FittedModel,
) -> Option<FoundFault> {
    let criteria = &subject.criteria.faults;
    let causes = last.linear.hypothesis.effects.len() - subject.known_effects.len();
    let explained = last.stats.is_clean(&subject.criteria.fit) && causes <= criteria.few_causes;
    if explained && !is_pushed(last) {
        return None;
    }
    let implausible = refitted.stats.is_implausible(&subject.criteria.fit);
    if refitted.stats.worst() < criteria.least_ratio && !implausible {
        return None;
    }
    let part = first_part(evidence, criteria.part_s);
    let left_by = |model: &FittedModel| {
        let start = model.linear.hypothesis.clone();
        Some(left(&part, subject, &fit(&part, subject, start, criteria.steps)?))
    };
    let (whole, by_causes) = (left_by(refitted)?, left_by(last)?);
    let bare = |fault: ModelFault| Trial::of(&part, subject, fault);
    let mut tried: Vec<Trial> = Vec::new();
    if implausible || leaves_much(subject, refitted) {
        tried.extend(ModelFault::without_size(subject).into_iter().filter_map(bare));
    }
    let sized = ModelFault::with_size(subject);
    tried.extend(sized.into_iter().filter_map(|fault| Some(bare(fault)?.with_size_found())));
    let best =
        tried.into_iter().min_by(|a, b| a.linear.objective.total_cmp(&b.linear.objective))?;
    let by_fault = left(&part, subject, &best.linear);
    let explained = 1.0 - by_fault / whole.max(1e-300);
    let as_good = by_fault <= f64::max(criteria.as_good * by_causes, criteria.sure * whole);
    (whole > 0.0 && explained > criteria.explained && as_good)
        .then_some(FoundFault { fault: best.fault, explained })
}

/// Whether a force at the tip is among the causes: a small one along gravity is what lengths do that are
/// a few per cent off.
fn is_pushed(model: &FittedModel) -> bool {
    let effects = &model.linear.hypothesis.effects;
    effects.iter().any(|effect| effect.definition.name == "tip_force")
}

/// A fault put right on a part of the logs, everything else refitted.
struct Trial<'a> {
    fault: ModelFault,
    part: &'a Evidence,
    subject: &'a Subject,
    linear: Linearisation,
}

impl<'a> Trial<'a> {
    fn of(part: &'a Evidence, subject: &'a Subject, fault: ModelFault) -> Option<Self> {
        let corrected = fault.corrected(subject);
        let evidence = part.with_stretches(|stretch| fault.correct(stretch));
        let steps = subject.criteria.faults.steps;
        let start = as_given(&corrected);
        let open = open_in(&evidence, &corrected, &start);
        let start = Linearisation::of(&evidence, start, open)?;
        let linear = fit_with_slopes(&evidence, &corrected, start, steps);
        Some(Self { fault, part, subject, linear })
    }

    /// The same with the size at which it explains most.
    fn with_size_found(self) -> Self {
        let mut best = self;
        let fit = &best.subject.criteria.fit;
        for _ in 0..best.subject.criteria.faults.size_steps {
            let better = best.next_size().and_then(|size| best.better_at(&size));
            let Some(better) = better else { break };
            let gain = best.linear.objective - better.linear.objective;
            let converged = gain < fit.converged_part * best.linear.objective;
            best = better;
            if converged {
                break;
            }
        }
        for size in best.fault.whole_periods(best.part.stretches[0].sampled_s) {
            best = best.better_at(&size).unwrap_or(best);
        }
        best
    }

    /// The same at another size, if it explains more there.
    fn better_at(&self, size: &[f64]) -> Option<Self> {
        let next = Self::of(self.part, self.subject, self.fault.sized(size))?;
        (next.linear.objective < self.linear.objective).then_some(next)
    }

    /// A Gauss-Newton step of the size, everything else refitted by the slopes.
    fn next_size(&self) -> Option<Vec<f64>> {
        let size = self.fault.size();
        let slopes: Vec<RowChange> = (0..size.len()).map(|k| self.slope(k)).collect();
        let (mut gradient, mut curvature) = self.linear.along(&RowChange::default(), &slopes);
        for k in 0..size.len() {
            let weight = self.deviation(k).powi(-2);
            gradient[k] += weight * size[k];
            curvature[(k, k)] += weight;
        }
        let step: DVector<f64> = curvature.cholesky()?.solve(&gradient);
        Some(size.iter().zip(step.iter()).map(|(size, step)| size - step).collect())
    }

    /// Change of the train rows per unit of a size.
    fn slope(&self, k: usize) -> RowChange {
        let step = SLOPE_STEP * self.deviation(k);
        let mut size = self.fault.size().to_vec();
        size[k] += step;
        let fault = self.fault.sized(&size);
        let corrected = fault.corrected(self.subject);
        let evidence = self.part.with_stretches(|stretch| fault.correct(stretch));
        let mut hypothesis = self.linear.hypothesis.clone();
        take_lengths(&mut hypothesis, &corrected);
        let moved = train_residual_rows(&evidence, &hypothesis);
        let change = |joint: usize, rows: &Rows| -> Vec<f64> {
            let both = rows[joint].iter().zip(&self.linear.residual[joint]);
            both.map(|(after, before)| (after - before) / step).collect()
        };
        let of_joint = |joint: usize| (!moved[joint].is_empty()).then(|| change(joint, &moved));
        (0..moved.len()).map(of_joint).collect()
    }

    /// How far a size may be off: a part of a length, or an angle.
    fn deviation(&self, k: usize) -> f64 {
        let criteria = &self.subject.criteria.faults;
        match self.fault {
            ModelFault::Lengths(_) => {
                let length_m = lengths_m(self.subject)[k].abs();
                criteria.length_part * length_m.max(criteria.least_length_m)
            }
            ModelFault::Late(_) => criteria.late_s,
            _ => criteria.home_rad,
        }
    }
}

/// Gives a hypothesis the lengths of a subject, where those of the closed form may be others.
fn take_lengths(hypothesis: &mut Hypothesis, subject: &Subject) {
    if let (Body::Rrr(own), Some(rrr)) = (&mut hypothesis.plant.body, subject.plant.body.as_rrr()) {
        own.geometry = rrr.geometry;
    }
}

/// Step for a difference along a size, in parts of its deviation.
const SLOPE_STEP: f64 = 0.01;

/// Squares that ask for a cause: those of rows above the method's own, in units of noise, and those of
/// parameters away from what is known of them.
fn left(part: &Evidence, subject: &Subject, linear: &Linearisation) -> f64 {
    let rows = part.joints.iter().map(|&joint| part.train_rows(joint)).sum::<usize>() as f64;
    let penalty = linear.prior_penalty();
    let expected = subject.criteria.fit.unexplained_prior_penalty;
    let own = subject.criteria.fit.own_ratio.powi(2) * rows;
    (linear.objective - penalty - own).max(0.0) + (penalty - expected).max(0.0)
}

/// The first seconds of each train log.
fn first_part(evidence: &Evidence, longest_s: f64) -> Evidence {
    let cut = |stretch: &mut Stretch| {
        let count = (longest_s / stretch.period_s) as usize;
        *stretch = stretch.part(0..count.clamp(1, stretch.len()));
    };
    evidence.train_only().with_stretches(cut)
}
