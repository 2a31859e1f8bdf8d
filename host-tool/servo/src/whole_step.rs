//! A step in the search for the values of an effect of the whole arm: Gauss and Newton's, the joints' own
//! unknowns eliminated (Schur's complement), those that stand at a bound held there.

use nalgebra::{DMatrix, DVector};

use crate::base::{Base, Frame};
use crate::fit::Unknown;
use crate::joint::ServoJoint;
use crate::judged::Judged;
use crate::whole_normal::{STEP_PART, normal};

/// A step of an effect's values.
pub struct Step {
    /// By how much the values change.
    pub moved: Vec<f64>,
    /// Standard deviations of the values.
    pub deviations: Vec<f64>,
    /// What it takes, were everything linear, in squares of one row.
    pub takes: f64,
}

/// A step of the effect's values, the joints' own unknowns moving along.
#[allow(clippy::too_many_arguments)]
pub fn step_of(
    frame: &Frame,
    bases: &[Base],
    servos: &[ServoJoint],
    logs: &[&Judged],
    apply: &dyn Fn(&[f64]) -> Vec<Judged>,
    values: &[f64],
    prior: &[f64],
    doubts: &[f64],
) -> Option<Step> {
    let p = values.len();
    let moved: Vec<Vec<Judged>> = (0..p)
        .map(|k| {
            let mut other = values.to_vec();
            other[k] += STEP_PART * doubts[k];
            apply(&other)
        })
        .collect();
    let equations = bases.iter().enumerate().map(|(joint, base)| {
        let unknowns = base.rigid_unknowns();
        let problem = Frame { logs, ..*frame }.problem(joint, &unknowns, base.scale);
        let (matrix, right) = normal(&problem, &servos[joint], &moved, doubts, base);
        OfJoint { unknowns, servo: servos[joint], matrix, right }
    });
    let mut joints: Vec<OfJoint> = equations.collect();
    loop {
        let (mut matrix, mut right) = (DMatrix::zeros(p, p), DVector::zeros(p));
        for k in 0..p {
            matrix[(k, k)] += doubts[k].powi(-2);
            right[k] += (prior[k] - values[k]) / doubts[k].powi(2);
        }
        for joint in &joints {
            let (own_matrix, own_right) = joint.eliminated()?;
            matrix += own_matrix;
            right += own_right;
        }
        let inverse = matrix.try_inverse()?;
        let found = &inverse * &right;
        if joints.iter_mut().any(|joint| joint.holds_one_more(&found)) {
            continue;
        }
        let deviations = (0..p).map(|k| inverse[(k, k)].max(0.0).sqrt()).collect();
        let takes = found.dot(&right);
        return Some(Step { moved: found.iter().copied().collect(), deviations, takes });
    }
}

/// Normal equations of a joint: its own unknowns, then the effect's values.
struct OfJoint {
    unknowns: Vec<Unknown>,
    servo: ServoJoint,
    matrix: DMatrix<f64>,
    right: DVector<f64>,
}

impl OfJoint {
    /// The effect's part, the joint's own unknowns moving along.
    fn eliminated(&self) -> Option<(DMatrix<f64>, DVector<f64>)> {
        let own = self.unknowns.len();
        let p = self.right.len() - own;
        let factor = self.matrix.view((0, 0), (own, own)).clone_owned().cholesky()?;
        let across = self.matrix.view((0, own), (own, p)).clone_owned();
        let rest = self.right.rows(0, own).clone_owned();
        let matrix = self.matrix.view((own, own), (p, p)) - across.tr_mul(&factor.solve(&across));
        let right = self.right.rows(own, p) - across.tr_mul(&factor.solve(&rest));
        Some((matrix, right))
    }

    /// Keeps an own unknown that stands at a bound and would leave its range by this step of the effect where it
    /// is; whether there is one.
    fn holds_one_more(&mut self, step: &DVector<f64>) -> bool {
        let own = self.unknowns.len();
        let Some(factor) = self.matrix.view((0, 0), (own, own)).clone_owned().cholesky() else {
            return false;
        };
        let across = self.matrix.view((0, own), (own, step.len())).clone_owned();
        let moved = factor.solve(&(self.right.rows(0, own) - across * step));
        let leaves = |k: &usize| self.unknowns[*k].leaves_range(&self.servo, moved[*k]);
        let Some(held) = (0..own).find(leaves) else { return false };
        self.matrix.row_mut(held).fill(0.0);
        self.matrix.column_mut(held).fill(0.0);
        (self.matrix[(held, held)], self.right[held]) = (1.0, 0.0);
        true
    }
}
