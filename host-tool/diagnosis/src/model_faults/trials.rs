//! Each fault put right, everything else refitted.

use nalgebra::DVector;

use super::fault::ModelFault;
use super::lengths::{change, length_doubt_m, take_lengths};
use crate::fit::gauss_newton::{fit_with_slopes, open_in};
use crate::fit::linearisation::Linearisation;
use crate::fit::preparation::as_given;
use crate::logs::stretch::Stretch;
use crate::logs::subject::Subject;
use crate::rows::evidence::{Evidence, RowChange};
use crate::trial::residual_rows::train_residual_rows;

/// A fault put right on a part of the logs, everything else refitted.
pub(super) struct Trial<'a> {
    pub(super) fault: ModelFault,
    part: &'a Evidence,
    subject: &'a Subject,
    pub(super) linear: Linearisation,
}

impl<'a> Trial<'a> {
    pub(super) fn of(part: &'a Evidence, subject: &'a Subject, fault: ModelFault) -> Option<Self> {
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
    pub(super) fn with_size_found(self) -> Self {
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
        change(&self.linear, &train_residual_rows(&evidence, &hypothesis), step)
    }

    /// How far a size may be off: a part of a length, or an angle.
    fn deviation(&self, k: usize) -> f64 {
        let criteria = &self.subject.criteria.faults;
        match self.fault {
            ModelFault::Lengths(_) => length_doubt_m(self.subject, k, criteria),
            ModelFault::Late(_) => criteria.late_s,
            _ => criteria.home_rad,
        }
    }
}

/// Step for a difference along a size, in parts of its deviation.
const SLOPE_STEP: f64 = 0.01;

/// Squares that ask for a cause: those of rows above the method's own, in units of noise, and those of
/// parameters away from what is known of them.
pub(super) fn left(part: &Evidence, subject: &Subject, linear: &Linearisation) -> f64 {
    let rows = part.joints.iter().map(|&joint| part.train_rows(joint)).sum::<usize>() as f64;
    let penalty = linear.prior_penalty();
    let expected = subject.criteria.fit.unexplained_prior_penalty;
    let own = subject.criteria.fit.own_ratio.powi(2) * rows;
    (linear.objective - penalty - own).max(0.0) + (penalty - expected).max(0.0)
}

/// The first seconds of each train log.
pub(super) fn first_part(evidence: &Evidence, longest_s: f64) -> Evidence {
    let cut = |stretch: &mut Stretch| {
        let count = (longest_s / stretch.period_s) as usize;
        *stretch = stretch.part(0..count.clamp(1, stretch.len()));
    };
    evidence.train_only().with_stretches(cut)
}
