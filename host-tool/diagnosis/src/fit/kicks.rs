//! Where a step of the command throws a joint so hard that its friction is not known for a while.
//!
//! A sampled log tells where a joint is at the samples, and a command steps between them: at most a T^2 / 8 from the
//! line between two samples, T apart, where the step accelerates the joint by a. Bristles of stiffness sigma0 then feel
//! up to sigma0 a T^2 / 8 of what no sample shows, and forget it by e with each bend that the joint goes further. On a
//! direct drive that is a fraction of a millivolt; on a geared wrist whose friction is compensated, many times the
//! noise at each reversal. A row that sees u of it beside noise n counts for the part 1 / sqrt(1 + (u / 6 n)^2)
//! (`kick_over_noise`): it still tells what is far larger, a late command say.

use super::inertia::lightest;
use crate::criteria::RowCriteria;
use crate::logs::bristle_path::path_rad;
use crate::logs::stretch::Stretch;
use crate::rows::evidence::Evidence;
use crate::trial::hypothesis::Hypothesis;

/// The part for which samples of a joint (from 0) in a stretch count; empty, all in full, where noise drives the joints,
/// and where less than half would count.
pub fn known_part(
    evidence: &Evidence,
    hypothesis: &Hypothesis,
    joint: usize,
    s: usize,
) -> Vec<f64> {
    let (stretch, criteria) = (&evidence.stretches[s], &evidence.criteria.rows);
    if stretch.broadband {
        return Vec::new();
    }
    let noise_v = criteria.kick_over_noise * evidence.floor_v(joint, s);
    Kick::of(stretch, hypothesis, joint).known_part(stretch, joint, noise_v, criteria)
}

/// What steps of the command do to a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Kick {
    /// What is not known of friction after a step, per size of the step.
    unknown_part: f64,
    /// The largest bend of the bristles [rad].
    bend_rad: f64,
}

impl Kick {
    /// Of a joint (from 0) in a stretch.
    fn of(stretch: &Stretch, hypothesis: &Hypothesis, joint: usize) -> Self {
        let friction = &hypothesis.plant.friction[joint];
        let inertia = lightest(stretch, hypothesis, joint);
        let square_s2 = stretch.period_s * stretch.period_s;
        Self {
            unknown_part: friction.sigma0_v_per_rad * square_s2 / (8.0 * inertia),
            bend_rad: path_rad(friction, 1.0),
        }
    }

    /// The part for which samples of a joint count beside noise; none where less than half of a log would count, for
    /// then it is what the log is about.
    fn known_part(
        &self,
        stretch: &Stretch,
        joint: usize,
        noise_v: f64,
        criteria: &RowCriteria,
    ) -> Vec<f64> {
        let unknown_v = self.unknown_v(&stretch.command_v[joint], &stretch.motion.q_rad[joint]);
        let reach = (criteria.reach_s(stretch.broadband) / stretch.period_s).ceil() as usize;
        let part = |unknown_v: f64| 1.0 / (unknown_v / noise_v).hypot(1.0);
        let known: Vec<f64> = most_within(&unknown_v, reach).into_iter().map(part).collect();
        let squares: f64 = known.iter().map(|part| part * part).sum();
        let is_most = squares < (1.0 - criteria.most_kicked_part) * known.len() as f64;
        if is_most { Vec::new() } else { known }
    }

    /// What is not known of a joint's friction at every sample [V]: of the largest step, until the joint has gone so
    /// many bends that a later one is more. A part of a bend beyond whole ones, between two samples, does not count: with
    /// it a dead zone of 42 mA was named on a wrist that had none.
    fn unknown_v(&self, command_v: &[f64], q_rad: &[f64]) -> Vec<f64> {
        let (mut unknown_v, mut at) = (0.0, q_rad.first().copied().unwrap_or_default());
        let at_sample = |k: usize| {
            let bends = ((q_rad[k] - at).abs() / self.bend_rad).floor();
            if bends > 0.0 {
                (unknown_v, at) = (unknown_v * (-bends).exp(), q_rad[k]);
            }
            let of_step = self.unknown_part * (command_v[k] - command_v[k.max(1) - 1]).abs();
            if of_step > unknown_v {
                (unknown_v, at) = (of_step, q_rad[k]);
            }
            unknown_v
        };
        (0..q_rad.len()).map(at_sample).collect()
    }
}

/// The largest of some values within a reach to either side, at each.
fn most_within(values: &[f64], reach: usize) -> Vec<f64> {
    let about = |k: usize| &values[k.saturating_sub(reach)..(k + reach + 1).min(values.len())];
    (0..values.len()).map(|k| about(k).iter().copied().fold(0.0, f64::max)).collect()
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
    fn samples_about_a_step_count_less_until_the_joint_has_gone_some_bends() {
        let (stretch, criteria) = (stepped(), RowCriteria::default());
        let kick = Kick { unknown_part: 0.01, bend_rad: 0.0105 };
        let known = kick.known_part(&stretch, 0, 5e-3, &criteria);
        let reach = (criteria.reach_s(stretch.broadband) / stretch.period_s).ceil() as usize;
        assert_eq!(known[500 - reach - 1], 1.0);
        assert!((known[500 - reach] - 0.2_f64.sqrt()).abs() < 1e-12, "{}", known[500 - reach]);
        assert!(known[515] < known[530] && known[530] < known[560], "{:?}", &known[510..560]);
        assert!(known[600] > 0.999, "{}", known[600]);
    }

    #[test]
    fn a_log_that_is_all_kicks_keeps_its_rows() {
        let (stretch, criteria) = (stepped(), RowCriteria::default());
        let kick = Kick { unknown_part: 0.05, bend_rad: 0.6 };
        assert!(kick.known_part(&stretch, 0, 5e-3, &criteria).is_empty());
    }
}
