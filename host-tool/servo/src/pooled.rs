//! Servos of one type: what they share, and whether load explains why their friction differs.
//!
//! Servos that the file describes alike come from one series and should rub alike. Where refitted
//! Coulomb levels differ from joint to joint, either the levels are the joints' own, or friction
//! grows with load. So the joints are refitted with one level in common, without and with one
//! coefficient of load friction in common.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::base::{Base, Frame};
use crate::candidates::MOST_LOST;
use crate::cross::{Gain, LeftOut};
use crate::fit::{Field, Fitted, Normal, Problem, Unknown, move_by};
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
    let coulomb = *bases[joints[0]]
        .unknowns
        .iter()
        .find(|u| u.field == Field::Coulomb)
        .expect("a base fits it");
    let shared: Vec<Unknown> = [coulomb].iter().chain(more).copied().collect();
    let lists: Vec<Vec<Unknown>> =
        joints.iter().map(|joint| list(&bases[*joint], &shared)).collect();
    let mut servos: Vec<ServoJoint> = joints.iter().map(|joint| starts[*joint]).collect();
    share_mean(&mut servos, &shared);
    let problems: Vec<Problem> = joints
        .iter()
        .zip(&lists)
        .map(|(joint, list)| frame.problem(*joint, list, bases[*joint].scale))
        .collect();
    let ones: Vec<f64> = joints.iter().map(|joint| bases[*joint].fitted.square_of_one).collect();
    let cost = |servos: &[ServoJoint]| -> f64 {
        problems
            .par_iter()
            .zip(servos)
            .zip(&ones)
            .map(|((p, s), one)| p.cost(s, p.robust(s), *one))
            .sum()
    };
    let mut before = cost(&servos);
    for _ in 0..ITERATIONS {
        let normals: Vec<Normal> =
            problems.par_iter().zip(&servos).map(|(problem, servo)| problem.sum(servo)).collect();
        let better = [1.0, 0.3, 0.1].iter().find_map(|part| {
            let next = stepped(&problems, &servos, &normals, &ones, shared.len(), *part)?;
            let after = cost(&next);
            (after < before).then_some((next, after))
        });
        let Some((next, after)) = better else { break };
        servos = next;
        let gain = before - after;
        before = after;
        if gain < 1e-3 * before {
            break;
        }
    }
    let left = left_together(&problems, &servos, &ones);
    Pool { joints: joints.to_vec(), shared, servos, left }
}

const ITERATIONS: usize = 10;

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

/// A step of Gauss and Newton's: own unknowns eliminated joint by joint.
fn stepped(
    problems: &[Problem],
    servos: &[ServoJoint],
    normals: &[Normal],
    ones: &[f64],
    shared: usize,
    part: f64,
) -> Option<Vec<ServoJoint>> {
    let (mut matrix, mut right) = (DMatrix::zeros(shared, shared), DVector::zeros(shared));
    let mut parts = Vec::new();
    for (((problem, servo), normal), one) in problems.iter().zip(servos).zip(normals).zip(ones) {
        let (full, side) = problem.with_priors(servo, normal, *one);
        let own = problem.unknowns.len() - shared;
        let factor = full.view((0, 0), (own, own)).clone_owned().cholesky()?;
        let across = full.view((0, own), (own, shared)).clone_owned();
        let rest = side.rows(0, own).clone_owned();
        matrix +=
            full.view((own, own), (shared, shared)) - across.transpose() * factor.solve(&across);
        right += side.rows(own, shared) - across.transpose() * factor.solve(&rest);
        parts.push((factor, across, rest));
    }
    let common = matrix.cholesky()?.solve(&right);
    let moved = parts.into_iter().map(|(factor, across, rest)| {
        let own = factor.solve(&(rest - across * &common));
        let mut all: Vec<f64> = own.iter().chain(common.iter()).copied().collect();
        all.iter_mut().for_each(|step| *step *= part);
        all
    });
    let next = problems.iter().zip(servos).zip(moved);
    Some(next.map(|((problem, servo), moved)| move_by(servo, problem.unknowns, &moved)).collect())
}

/// What is left of each log, all joints together.
fn left_together(problems: &[Problem], servos: &[ServoJoint], ones: &[f64]) -> LeftOut {
    let logs = problems[0].logs.len();
    let mut sum =
        LeftOut { robust: vec![0.0; logs], squares: vec![0.0; logs], rows: vec![0; logs] };
    for ((problem, servo), one) in problems.iter().zip(servos).zip(ones) {
        let fitted = Fitted { servo: *servo, normals: Vec::new(), square_of_one: *one };
        let left = LeftOut::of_fit(&fitted, problem);
        for log in 0..logs {
            sum.robust[log] += left.robust[log] / one;
            sum.squares[log] += left.squares[log] / one;
            sum.rows[log] += left.rows[log];
        }
    }
    sum
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
    let size = 0.2 / bases[joints[0]].given.torque_constant;
    let field = Field::MotorLoadFriction;
    let most = MOST_LOST / bases[joints[0]].given.torque_constant;
    let unknown = Unknown::between(field, [0.0, most], (0.0, 10.0 * size), 0.1 * size);
    let loaded: Vec<ServoJoint> = starts
        .iter()
        .map(|servo| ServoJoint {
            motor_load_friction: 1.5 * size,
            coulomb: 0.5 * servo.coulomb,
            ..*servo
        })
        .collect();
    let with = pool(frame, bases, joints, &[unknown], &loaded);
    let gain = Gain::of(&with.left, &without.left);
    PooledLoad { without, with, gain }
}
