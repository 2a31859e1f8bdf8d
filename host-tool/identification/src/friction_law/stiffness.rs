//! How soft bristles may be before the data object: a stiffness for joints without bristles.
//!
//! A model's readers integrate bristles, so static friction is written with stiff ones. The
//! softest that the data bear are the kindest to whatever steps through them; with that the
//! number has a meaning: sigma0 is at least this.

use model::Robot;

use super::evidence::{Block, Fitted, blocks_of, left_by};
use super::halves::Fold;

/// Stiffness is halved so often at most: from 20 um of travel to 10 mm.
const HALVINGS: i32 = 9;
/// Loss in squares that is taken for none.
const NO_LOSS: f64 = 1e-3;

/// The least sigma0 of each joint [V/rad] that leaves no more of the predicted halves than the
/// one that static friction was fitted with.
pub(super) fn softest(folds: &[Fold], fitted: &[Fitted]) -> [f64; 3] {
    let stiff = [0, 1, 2].map(|i| fitted[0].robot.friction[i].sigma0_v_per_rad);
    let mut found = stiff;
    let mut open = [true; 3];
    for halving in 1..=HALVINGS {
        let part = 0.5f64.powi(halving);
        let softened = |fitted: &Fitted| softened(&fitted.robot, &stiff, part);
        let left = folds.iter().zip(fitted).map(|(fold, fitted)| {
            let robot = softened(fitted);
            Some(Fitted { robot, left: left_by(&robot, &fold.predicted)? })
        });
        let Some(left) = left.collect::<Option<Vec<_>>>() else { break };
        for i in 0..3 {
            open[i] &= !objects(&blocks_of(fitted, i), &blocks_of(&left, i));
            if open[i] {
                found[i] = stiff[i] * part;
            }
        }
    }
    found
}

fn softened(robot: &Robot<f64>, stiff: &[f64; 3], part: f64) -> Robot<f64> {
    let mut robot = *robot;
    for (friction, stiff) in robot.friction.iter_mut().zip(stiff) {
        friction.sigma0_v_per_rad = stiff * part;
    }
    robot
}

/// Whether softer bristles leave more than stiff ones do.
fn objects(stiff: &[Block], soft: &[Block]) -> bool {
    sum_v2(soft) > (1.0 + NO_LOSS) * sum_v2(stiff)
}

fn sum_v2(blocks: &[Block]) -> f64 {
    blocks.iter().map(|block| block.sum_v2).sum()
}
