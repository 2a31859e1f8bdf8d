//! Rows by the speed of their joint: friction is worst known around standstill.

use super::evidence::Evidence;

/// Speeds that part the train rows of a joint into classes of equal size [rad/s].
pub fn speed_edges(evidence: &Evidence, joint: usize) -> Vec<f64> {
    let mut speeds: Vec<f64> = (0..evidence.train_stretches())
        .flat_map(|s| row_speeds(evidence, joint, s).collect::<Vec<f64>>())
        .collect();
    if speeds.is_empty() {
        return Vec::new();
    }
    speeds.sort_unstable_by(f64::total_cmp);
    let last = (speeds.len() - 1) as f64;
    evidence.criteria.rows.speed_classes.iter().map(|part| speeds[(part * last) as usize]).collect()
}

/// The class of every row of a stretch.
pub fn classes(evidence: &Evidence, joint: usize, s: usize, edges: &[f64]) -> Vec<u8> {
    let class = |speed: f64| edges.iter().filter(|edge| speed > **edge).count() as u8;
    row_speeds(evidence, joint, s).map(class).collect()
}

fn row_speeds(evidence: &Evidence, joint: usize, s: usize) -> impl Iterator<Item = f64> {
    let stretch = &evidence.stretches[s];
    let instants = evidence.filter(joint, s).instants(stretch.len());
    instants.map(move |k| stretch.motion.qd_rad_per_s[joint][k].abs())
}
