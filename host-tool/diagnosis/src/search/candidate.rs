//! One more effect in a model: the values that suit the train logs best.

use nalgebra::{DMatrix, DVector};

use crate::fit::linearisation::Linearisation;
use crate::fit::row_changes::Joints;
use crate::fit::slopes::step_of;
use crate::rows::evidence::{Evidence, RowChange};
use crate::trial::hypothesis::EffectInstance;
use rig::effects::Kind;

/// An effect with its best values so far, and how well the model does with it on train logs.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The effect.
    pub effect: EffectInstance,
    /// Squares of train rows and of the prior penalty with it, everything open refitted.
    pub train: f64,
}

impl Candidate {
    /// A candidate with the values as they are.
    pub fn of(
        linear: &Linearisation,
        evidence: &Evidence,
        mut effect: EffectInstance,
    ) -> (Self, RowChange) {
        effect.normalise();
        let change = linear.change_by(evidence, &effect, Joints::All);
        let train = linear.objective_with(&change);
        (Self { effect, train }, change)
    }

    /// Searches from the candidate's values: Levenberg-Marquardt, everything open in the
    /// model eliminated by its slopes.
    pub fn refined(self, linear: &Linearisation, evidence: &Evidence, most_steps: usize) -> Self {
        let (mut best, mut change) = Self::of(linear, evidence, self.effect);
        let mut damping = 1e-3;
        for _ in 0..most_steps {
            let free = best.free_values();
            let slopes: Vec<RowChange> =
                free.iter().map(|&v| best.slope(linear, evidence, &change, v)).collect();
            let (gradient, curvature) = linear.along(&change, &slopes);
            let before = best.train;
            let found = (0..4).find_map(|_| {
                let values = best.stepped(&free, &gradient, &curvature, damping);
                let trial = EffectInstance { values, ..best.effect.clone() };
                let (next, next_change) = Self::of(linear, evidence, trial);
                if next.train < best.train {
                    damping *= 0.1;
                    return Some((next, next_change));
                }
                damping = (damping * 30.0).max(1e-2);
                None
            });
            let Some((next, next_change)) = found else { break };
            (best, change) = (next, next_change);
            if before - best.train < evidence.criteria.search.converged_part * best.train {
                break;
            }
        }
        best
    }

    /// Indices of the values that a search changes.
    fn free_values(&self) -> Vec<usize> {
        let parameters = self.effect.definition.parameters.iter().enumerate();
        parameters.filter(|(_, p)| !p.kind.is_tried()).map(|(index, _)| index).collect()
    }

    /// Slope of the rows along a value.
    fn slope(
        &self,
        linear: &Linearisation,
        evidence: &Evidence,
        change: &RowChange,
        value: usize,
    ) -> RowChange {
        let mut moved = self.effect.clone();
        let step = step_of(&moved, value);
        moved.values[value] += step;
        let mut slope = linear.change_by(evidence, &moved, Joints::All);
        for (rows, before) in slope.iter_mut().flatten().zip(change.iter().flatten()) {
            rows.iter_mut().zip(before).for_each(|(row, before)| *row = (*row - before) / step);
        }
        slope
    }

    /// Values after a damped step, kept in bounds; a step goes no further than to a tenth
    /// or tenfold of what must be positive.
    fn stepped(
        &self,
        free: &[usize],
        gradient: &DVector<f64>,
        curvature: &DMatrix<f64>,
        damping: f64,
    ) -> Vec<f64> {
        let mut values = self.effect.values.clone();
        let parameters = self.effect.definition.parameters;
        let mut system = curvature.clone();
        for (k, &value) in free.iter().enumerate() {
            let parameter = &parameters[value];
            let loose = (0.5 * (parameter.highest - parameter.lowest)).powi(-2);
            system[(k, k)] += damping * curvature[(k, k)].max(0.0) + loose + 1e-12;
        }
        let Some(step) = system.lu().solve(gradient) else { return values };
        for (k, &value) in free.iter().enumerate() {
            let now = values[value];
            let parameter = &parameters[value];
            if !step[k].is_finite() {
                continue;
            }
            values[value] = match parameter.lowest > 0.0 || parameter.kind == Kind::Gap {
                true => (now - step[k]).clamp(0.1 * now, 10.0 * now),
                false => now - step[k],
            };
        }
        values
    }
}
