//! Squares of what a model leaves above the noise, joint by joint.

use std::collections::BTreeMap;

use crate::rows::evidence::{Evidence, Rows};
use crate::rows::speed_classes::{classes, speed_edges};
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

/// What is left of some rows of a joint, and what noise alone leaves [V^2].
#[derive(Clone, Copy, Debug, Default)]
pub struct Left {
    /// Squares of the rows.
    pub square_v2: f64,
    /// Those of noise.
    pub noise_v2: f64,
}

/// What is left of each joint of the rig in each log of a role.
pub fn left_by_log(evidence: &Evidence, residual_v: &Rows, role: Role) -> Vec<Left> {
    let mut logs: BTreeMap<(usize, usize), Left> = BTreeMap::new();
    for &joint in &evidence.joints {
        for (s, left) in of_stretches(evidence, residual_v, joint, role) {
            let of_log = logs.entry((joint, evidence.stretches[s].log)).or_default();
            of_log.square_v2 += left.square_v2;
            of_log.noise_v2 += left.noise_v2;
        }
    }
    logs.into_values().collect()
}

/// What is left of a joint (from 0) in all train logs, by class of speed.
pub fn left_by_speed(evidence: &Evidence, residual_v: &Rows, joint: usize) -> Vec<Left> {
    let edges = speed_edges(evidence, joint);
    let mut left = vec![Left::default(); edges.len() + 1];
    let ranges = evidence.ranges(joint).into_iter().take(evidence.train_stretches());
    for (s, range) in ranges.enumerate() {
        let noise_v2 = evidence.floor_v(joint, s).powi(2);
        let rows = classes(evidence, joint, s, &edges).into_iter().zip(&residual_v[joint][range]);
        // Rows that are exactly zero have no weight.
        for (class, row) in rows.filter(|(_, row)| **row != 0.0) {
            let of_class = &mut left[usize::from(class)];
            of_class.square_v2 += row * row;
            of_class.noise_v2 += noise_v2;
        }
    }
    left
}

fn of_stretches(
    evidence: &Evidence,
    residual_v: &Rows,
    joint: usize,
    role: Role,
) -> impl Iterator<Item = (usize, Left)> {
    let ranges = evidence.ranges(joint).into_iter().enumerate();
    let of_role = ranges.filter(move |(s, _)| evidence.stretches[*s].role == role);
    of_role.map(move |(s, range)| {
        let square_v2 = residual_v[joint][range].iter().map(|row| row * row).sum();
        let rows = evidence.used_rows(joint, s) as f64;
        (s, Left { square_v2, noise_v2: rows * evidence.floor_v(joint, s).powi(2) })
    })
}
