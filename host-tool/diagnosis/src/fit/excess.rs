//! Squares of what a model leaves above the noise, joint by joint.

use std::collections::BTreeMap;

use crate::rows::evidence::{Evidence, Rows};
use files::Role;

/// Squares above those of noise of each joint of the rig in the logs of a role [V^2]. A log that leaves
/// less than its noise, which is then told too large, makes up for none that leaves more.
pub fn excess_v2(evidence: &Evidence, residual_v: &Rows, role: Role) -> Vec<f64> {
    let of_joint = |&joint: &usize| -> f64 {
        let left = of_stretches(evidence, residual_v, joint, role);
        left.map(|(_, left)| (left.square_v2 - left.noise_v2).max(0.0)).sum()
    };
    evidence.joints.iter().map(of_joint).collect()
}

/// What is left of a joint in a log, and what noise alone leaves [V^2].
#[derive(Clone, Copy, Debug, Default)]
pub struct LeftOfLog {
    /// Squares of its rows.
    pub square_v2: f64,
    /// Those of noise.
    pub noise_v2: f64,
}

/// What is left of each joint of the rig in each log of a role.
pub fn left_by_log(evidence: &Evidence, residual_v: &Rows, role: Role) -> Vec<LeftOfLog> {
    let mut logs: BTreeMap<(usize, usize), LeftOfLog> = BTreeMap::new();
    for &joint in &evidence.joints {
        for (s, left) in of_stretches(evidence, residual_v, joint, role) {
            let of_log = logs.entry((joint, evidence.stretches[s].log)).or_default();
            of_log.square_v2 += left.square_v2;
            of_log.noise_v2 += left.noise_v2;
        }
    }
    logs.into_values().collect()
}

fn of_stretches(
    evidence: &Evidence,
    residual_v: &Rows,
    joint: usize,
    role: Role,
) -> impl Iterator<Item = (usize, LeftOfLog)> {
    let ranges = evidence.ranges(joint).into_iter().enumerate();
    let of_role = ranges.filter(move |(s, _)| evidence.stretches[*s].role == role);
    of_role.map(move |(s, range)| {
        let square_v2 = residual_v[joint][range].iter().map(|row| row * row).sum();
        let rows = evidence.used_rows(joint, s) as f64;
        (s, LeftOfLog { square_v2, noise_v2: rows * evidence.floor_v(joint, s).powi(2) })
    })
}
