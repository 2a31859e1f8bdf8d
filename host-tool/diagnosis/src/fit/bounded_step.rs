//! The step of what is open that fits best, by the slopes of a model, each value within its range.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::linearisation::Linearisation;
use super::unknowns::Unknown;
use crate::trial::hypothesis::Hypothesis;

impl Linearisation {
    /// The change of what is open that fits best, by the slopes, where each value may go no further
    /// than its range: what would is fixed at its end, and the others are solved for again.
    pub fn step_within(&self, range: impl Fn(Unknown) -> [f64; 2]) -> DVector<f64> {
        let (mut normal, mut gradient) = (self.normal(), self.gradient.clone());
        let mut step = -self.normal.solve(&gradient);
        let mut is_free = vec![true; step.len()];
        loop {
            let mut any = false;
            for (place, expected) in self.expected.iter().enumerate() {
                if !is_free[place] {
                    continue;
                }
                let now = expected.unknown.get(&self.hypothesis);
                let [lowest, highest] = range(expected.unknown);
                let to = (now + step[place]).clamp(lowest.min(now), highest.max(now)) - now;
                if to != step[place] {
                    (is_free[place], any) = (false, true);
                    fix(&mut normal, &mut gradient, place, to);
                }
            }
            match Cholesky::new(normal.clone()) {
                Some(factors) if any => step = -factors.solve(&gradient),
                _ => return step,
            }
        }
    }

    /// By how much a step lowers the objective, by the slopes.
    pub fn gain_of(&self, step: &DVector<f64>) -> f64 {
        -2.0 * self.gradient.dot(step) - step.dot(&(self.normal() * step))
    }

    /// The hypothesis a part of a step further.
    pub fn moved(&self, step: &DVector<f64>, part: f64) -> Hypothesis {
        let mut hypothesis = self.hypothesis.clone();
        for (expected, change) in self.expected.iter().zip(step.iter()) {
            let now = expected.unknown.get(&self.hypothesis);
            expected.unknown.set(&mut hypothesis, now + part * change);
        }
        hypothesis
    }
}

/// Makes a step's value at a place what it is told: by a weight that outweighs all rows.
fn fix(normal: &mut DMatrix<f64>, gradient: &mut DVector<f64>, place: usize, to: f64) {
    let weight = 1e9 * normal[(place, place)];
    normal[(place, place)] += weight;
    gradient[place] -= weight * to;
}
