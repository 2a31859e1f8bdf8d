//! Where a step of the command throws a joint so hard that its friction is not known for a while.
//!
//! A sampled log tells where a joint is at the samples, and a command steps between them: at most a T^2 / 8 from the
//! line between two samples, T apart, where the step accelerates the joint by a. Bristles of stiffness sigma0 then feel
//! up to sigma0 a T^2 / 8 of what no sample shows, and forget it once the joint has gone some bends further. On a
//! direct drive that is a fraction of a millivolt; on a geared wrist whose friction is compensated, many times the
//! noise at each reversal.

use super::inertia::lightest;
use crate::criteria::RowCriteria;
use crate::logs::bristle_path::path_rad;
use crate::logs::stretch::Stretch;
use crate::rows::evidence::Evidence;
use crate::trial::hypothesis::Hypothesis;

/// Samples of a joint (from 0) in a stretch whose rows see friction that a kick leaves unknown; empty where there is
/// none, where noise drives the joints, and on the three-joint robot, which is a direct drive.
pub fn kicked(evidence: &Evidence, hypothesis: &Hypothesis, joint: usize, s: usize) -> Vec<bool> {
    let (stretch, criteria) = (&evidence.stretches[s], &evidence.criteria);
    if stretch.broadband || hypothesis.plant.as_chain().is_none() {
        return Vec::new();
    }
    let kick = Kick::of(stretch, hypothesis, joint, criteria.logs.settled_bends);
    let most_v = criteria.rows.kick_over_noise * evidence.floor_v(joint, s);
    kick.samples(stretch, joint, most_v, &criteria.rows)
}

/// What steps of the command do to a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Kick {
    /// What is not known of friction after a step, per size of the step.
    unknown_part: f64,
    /// The way after which friction has forgotten it [rad].
    path_rad: f64,
}

impl Kick {
    /// Of a joint (from 0) in a stretch.
    fn of(stretch: &Stretch, hypothesis: &Hypothesis, joint: usize, bends: f64) -> Self {
        let friction = &hypothesis.plant.friction[joint];
        let inertia = lightest(stretch, hypothesis, joint);
        let square_s2 = stretch.period_s * stretch.period_s;
        Self {
            unknown_part: friction.sigma0_v_per_rad * square_s2 / (8.0 * inertia),
            path_rad: path_rad(friction, bends),
        }
    }

    /// Samples of a joint whose rows see friction that is not known by more than `most_v`; none where that is most of
    /// them, for then it is what the log is about.
    fn samples(
        &self,
        stretch: &Stretch,
        joint: usize,
        most_v: f64,
        criteria: &RowCriteria,
    ) -> Vec<bool> {
        let (command_v, q_rad) = (&stretch.command_v[joint], &stretch.motion.q_rad[joint]);
        let reach = (criteria.reach_s(stretch.broadband) / stretch.period_s).ceil() as usize;
        let is_kick =
            |k: &usize| self.unknown_part * (command_v[*k] - command_v[*k - 1]).abs() > most_v;
        let mut kicked = vec![false; q_rad.len()];
        for k in (1..q_rad.len()).filter(is_kick) {
            let end = (self.forgotten(q_rad, k) + reach).min(q_rad.len());
            kicked[k.saturating_sub(reach)..end].fill(true);
        }
        let count = kicked.iter().filter(|kicked| **kicked).count();
        let is_most = count as f64 > criteria.most_kicked_part * kicked.len() as f64;
        if is_most || count == 0 { Vec::new() } else { kicked }
    }

    /// The first sample after a step by which the joint has gone its path.
    fn forgotten(&self, q_rad: &[f64], from: usize) -> usize {
        let gone = |q: &f64| (q - q_rad[from]).abs() > self.path_rad;
        q_rad[from..].iter().position(gone).map_or(q_rad.len(), |after| from + after)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::logs::kinematics::Kinematics;
    use crate::trial::test_stretch::stretch_of;

    /// A joint that goes 1 rad/s under a command that steps by 1 V after half of a second.
    fn stepped() -> Stretch {
        let mut motion = Kinematics::of_joints(3);
        for joint in 0..3 {
            motion.q_rad[joint] = (0..1000).map(|k| 1e-3 * f64::from(k)).collect();
            motion.qd_rad_per_s[joint] = vec![1.0; 1000];
            motion.qdd_rad_per_s2[joint] = vec![0.0; 1000];
            motion.raw_rad[joint] = motion.q_rad[joint].clone();
        }
        let command_v = (0..1000).map(|k| if k < 500 { 0.0 } else { 1.0 }).collect();
        stretch_of(motion, vec![command_v, vec![0.0; 1000], vec![0.0; 1000]], false)
    }

    #[test]
    fn samples_about_a_step_are_left_out_until_the_joint_has_gone_its_path() {
        let (stretch, criteria) = (stepped(), RowCriteria::default());
        let kick = Kick { unknown_part: 0.01, path_rad: 0.0505 };
        let kicked = kick.samples(&stretch, 0, 5e-3, &criteria);
        let reach = (criteria.reach_s(stretch.broadband) / stretch.period_s).ceil() as usize;
        let first = kicked.iter().position(|kicked| *kicked);
        let last = kicked.iter().rposition(|kicked| *kicked);
        assert_eq!(first, Some(500 - reach));
        assert_eq!(last, Some(550 + reach));
    }

    #[test]
    fn a_step_that_hardly_moves_the_joint_is_no_kick() {
        let (stretch, criteria) = (stepped(), RowCriteria::default());
        let kick = Kick { unknown_part: 0.001, path_rad: 0.05 };
        assert!(kick.samples(&stretch, 0, 5e-3, &criteria).is_empty());
    }

    #[test]
    fn a_log_that_is_all_kicks_keeps_its_rows() {
        let (stretch, criteria) = (stepped(), RowCriteria::default());
        let kick = Kick { unknown_part: 0.01, path_rad: 0.6 };
        assert!(kick.samples(&stretch, 0, 5e-3, &criteria).is_empty());
    }
}
