//! Squares of what a model leaves above the noise, joint by joint.

use crate::rows::evidence::{Evidence, Rows};
use files::Role;

/// Squares above those of noise of each joint of the rig in the logs of a role [V^2]. A log that leaves
/// less than its noise, which is then told too large, makes up for none that leaves more.
pub fn excess_v2(evidence: &Evidence, residual_v: &Rows, role: Role) -> Vec<f64> {
    let by_stretch = excess_by_stretch_v2(evidence, residual_v, role, 1.0);
    by_stretch.iter().map(|of_joint| of_joint.iter().sum()).collect()
}

/// Squares above so many times those of noise, by joint of the rig and stretch of a role [V^2].
pub fn excess_by_stretch_v2(
    evidence: &Evidence,
    residual_v: &Rows,
    role: Role,
    times_noise: f64,
) -> Vec<Vec<f64>> {
    let of_joint = |&joint: &usize| -> Vec<f64> {
        let ranges = evidence.ranges(joint).into_iter().enumerate();
        let of_role = ranges.filter(|(s, _)| evidence.stretches[*s].role == role);
        of_role
            .map(|(s, range)| {
                let square_v2: f64 = residual_v[joint][range].iter().map(|row| row * row).sum();
                let noise_v2 =
                    evidence.used_rows(joint, s) as f64 * evidence.floor_v(joint, s).powi(2);
                (square_v2 - times_noise * noise_v2).max(0.0)
            })
            .collect()
    };
    evidence.joints.iter().map(of_joint).collect()
}
