//! Servos of one type: what they share, and whether load explains why their friction differs.
//!
//! Servos that the file describes alike come from one series and should rub alike. Where refitted
//! Coulomb levels differ from joint to joint, either the levels are the joints' own, or friction
//! grows with load. So the joints are refitted with one level in common, without and with one
//! coefficient of load friction in common.

use crate::base::{Base, Frame};
use crate::candidates::{MOST_LOST, free};
use crate::common_fit::CommonFit;
use crate::cross::{Gain, LeftOut};
use crate::fit::{Field, Unknown};
use crate::joint::ServoJoint;

/// Joints of one type fitted together.
#[derive(Clone, Debug)]
pub struct Pool {
    /// Their indices.
    pub joints: Vec<usize>,
    /// What they share.
    pub shared: Vec<Unknown>,
    /// Fitted, in that order.
    pub servos: Vec<ServoJoint>,
    /// What is left of the logs, in parts of what one independent row of the joint leaves.
    pub left: LeftOut,
}

/// Groups of three joints or more whose drives, rotors and friction are given alike.
pub fn groups(given: &[ServoJoint]) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for (joint, servo) in given.iter().enumerate() {
        let same = |group: &&mut Vec<usize>| given[group[0]] == *servo;
        match groups.iter_mut().find(same) {
            Some(group) => group.push(joint),
            None => groups.push(vec![joint]),
        }
    }
    groups.retain(|group| group.len() >= 3);
    groups
}

/// Fits joints with their Coulomb level in common, and `more` as well; `starts` by joint.
pub fn pool(
    frame: &Frame,
    bases: &[Base],
    joints: &[usize],
    more: &[Unknown],
    starts: &[ServoJoint],
) -> Pool {
    let shared = shared_unknowns(&bases[joints[0]], more);
    let lists: Vec<Vec<Unknown>> =
        joints.iter().map(|joint| list(&bases[*joint], &shared)).collect();
    let mut servos: Vec<ServoJoint> = joints.iter().map(|joint| starts[*joint]).collect();
    share_mean(&mut servos, &shared);
    let problems = joints.iter().zip(&lists);
    let problems = problems.map(|(joint, list)| frame.problem(*joint, list, bases[*joint].scale));
    let ones = joints.iter().map(|joint| bases[*joint].fitted.square_of_one).collect();
    let common = CommonFit { problems: problems.collect(), ones, shared: shared.len() };
    let servos = common.fit(servos);
    let left = common.left(&servos);
    Pool { joints: joints.to_vec(), shared, servos, left }
}

/// The Coulomb level of a base, and what else is to be shared.
fn shared_unknowns(base: &Base, more: &[Unknown]) -> Vec<Unknown> {
    let is_level = |unknown: &&Unknown| unknown.field == Field::Coulomb;
    let level = base.unknowns.iter().find(is_level).expect("a base fits it");
    [level].into_iter().chain(more).copied().collect()
}

/// A joint's own unknowns, then those that are shared.
fn list(base: &Base, shared: &[Unknown]) -> Vec<Unknown> {
    let own = base.unknowns.iter().filter(|own| shared.iter().all(|s| s.field != own.field));
    own.chain(shared).copied().collect()
}

/// What is shared begins at the mean of all.
fn share_mean(servos: &mut [ServoJoint], shared: &[Unknown]) {
    for unknown in shared {
        let mean = servos.iter().map(|s| unknown.coordinate(s)).sum::<f64>() / servos.len() as f64;
        servos.iter_mut().for_each(|servo| unknown.put(servo, mean));
    }
}

/// Load friction in common over none, of a group.
#[derive(Clone, Debug)]
pub struct PooledLoad {
    /// One level of friction in common.
    pub without: Pool,
    /// And one coefficient of load friction.
    pub with: Pool,
    /// What the coefficient gains on the train logs.
    pub gain: Gain,
}

/// Tries load friction by the motor's torque on a group.
pub fn load_friction(frame: &Frame, bases: &[Base], joints: &[usize]) -> PooledLoad {
    let starts: Vec<ServoJoint> = bases.iter().map(|base| base.fitted.servo).collect();
    let without = pool(frame, bases, joints, &[], &starts);
    let one = 1.0 / bases[joints[0]].given.torque_constant;
    let unknown = free(Field::MotorLoadFriction, [0.0, MOST_LOST * one], 0.2 * one);
    let loaded = |servo: &ServoJoint| ServoJoint {
        motor_load_friction: 0.3 * one,
        coulomb: 0.5 * servo.coulomb,
        ..*servo
    };
    let loaded: Vec<ServoJoint> = starts.iter().map(loaded).collect();
    let with = pool(frame, bases, joints, &[unknown], &loaded);
    let gain = Gain::of(&with.left, &without.left);
    PooledLoad { without, with, gain }
}
