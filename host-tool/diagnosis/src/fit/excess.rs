//! Squares of what a model leaves above the noise, joint by joint.

use crate::rows::evidence::{Evidence, Rows};
use files::Role;

/// Squares above those of noise of each joint of the rig in the logs of a role [V^2].
pub fn excess_v2(evidence: &Evidence, residual_v: &Rows, role: Role) -> Vec<f64> {
    let of_joint = |&joint: &usize| -> f64 {
        let ranges = evidence.ranges(joint).into_iter().enumerate();
        let of_role = ranges.filter(|(s, _)| evidence.stretches[*s].role == role);
        of_role
            .map(|(s, range)| {
                let square_v2: f64 = residual_v[joint][range].iter().map(|row| row * row).sum();
                square_v2 - evidence.used_rows(joint, s) as f64 * evidence.floor_v(joint, s).powi(2)
            })
            .sum()
    };
    evidence.joints.iter().map(of_joint).collect()
}
