//! What a rigid body needs along the motion of a stretch: the closed form with its sines and
//! cosines computed once, or any chain.

use model::Posture;
use model::base::COUNT;
use model::chain::MAX_JOINTS;
use model::mechanism::Rrr;
use rig::plant::{Body, LinkedBody};

use crate::logs::kinematics::{Joints, Kinematics, Sines};

/// A motion, with its sines and cosines where the closed form takes them.
#[derive(Clone, Copy, Debug)]
pub struct Path<'a> {
    /// The motion of the links.
    pub motion: &'a Kinematics,
    /// Sines and cosines at its samples, as the closed form takes them; none for a chain.
    pub postures: &'a [Posture<f64>],
    /// The same by joints, where torques of a chain are asked for.
    pub sines: &'a [Sines],
}

/// Torques that the motion needs at the samples, joint by joint [Nm].
pub fn torques(body: &Body, path: Path) -> Vec<Vec<f64>> {
    let (joints, samples) = (body.joints(), path.motion.q_rad[0].len());
    let mut torques = vec![Vec::with_capacity(samples); joints];
    match body {
        Body::Rrr(rrr) => {
            for (k, posture) in path.postures.iter().enumerate() {
                let (_, qd, qdd) = path.motion.of_three(k);
                let torque = posture.inverse_dynamics(&rrr.base, &rrr.geometry, &qd, &qdd);
                (0..3).for_each(|joint| torques[joint].push(torque[joint]));
            }
        }
        Body::Chain(linked) => {
            let mut sines = [(0.0, 1.0); MAX_JOINTS];
            for k in 0..samples {
                let [q, qd, qdd] = path.motion.state(k);
                sines.iter_mut().zip(path.sines).for_each(|(at, of_joint)| *at = of_joint[k]);
                let mut torque = Joints::default();
                linked.chain.inverse_dynamics_with_sines(&sines, &q, &qd, &qdd, &mut torque);
                torques.iter_mut().zip(torque).for_each(|(column, torque)| column.push(torque));
            }
        }
    }
    torques
}

/// The smallest inertia that a joint has along the motion [kg m^2].
pub fn smallest_inertia(body: &Body, joint: usize, path: Path) -> f64 {
    let smallest =
        |of_samples: &mut dyn Iterator<Item = f64>| of_samples.fold(f64::INFINITY, f64::min);
    match body {
        Body::Rrr(Rrr { base, geometry }) => {
            let inertia =
                |posture: &Posture<f64>| posture.mass_matrix(base, geometry)[joint][joint];
            smallest(&mut path.postures.iter().map(inertia))
        }
        Body::Chain(_) => {
            let inertia = |k: usize| body.inertia(joint, &path.motion.state(k)[0]);
            smallest(&mut (0..path.motion.q_rad[0].len()).step_by(EVERY).map(inertia))
        }
    }
}

/// A chain's inertia changes slowly: every so many samples show the smallest.
const EVERY: usize = 10;

/// Columns of a joint's row of the regressor at the samples, one per base parameter or coordinate
/// [Nm per its unit]; none where the joint does not depend on it.
pub fn regressor_columns(body: &Body, joint: usize, path: Path) -> Vec<Option<Vec<f64>>> {
    match body {
        Body::Rrr(rrr) => of_rrr(rrr, joint, path),
        Body::Chain(linked) => of_chain(linked, joint, path),
    }
}

fn of_rrr(rrr: &Rrr<f64>, joint: usize, path: Path) -> Vec<Option<Vec<f64>>> {
    let at = |k: usize| -> [f64; COUNT] {
        let (_, qd, qdd) = path.motion.of_three(k);
        model::regressor::regressor(&path.postures[k], &rrr.geometry, &qd, &qdd)[joint]
    };
    let rows: Vec<[f64; COUNT]> = (0..path.postures.len()).map(at).collect();
    let column = |k: usize| counts(joint, k).then(|| rows.iter().map(|row| row[k]).collect());
    (0..COUNT).map(column).collect()
}

fn of_chain(linked: &LinkedBody, joint: usize, path: Path) -> Vec<Option<Vec<f64>>> {
    let count = linked.coordinates().len();
    let samples = path.motion.q_rad[0].len();
    let empty = |k: usize| linked.counts(joint, k).then(|| Vec::with_capacity(samples));
    let mut columns: Vec<Option<Vec<f64>>> = (0..count).map(empty).collect();
    let mut row = vec![0.0; count];
    for k in 0..samples {
        let [q, qd, qdd] = path.motion.state(k);
        linked.row(joint, &q, &qd, &qdd, &mut row);
        for (column, value) in columns.iter_mut().zip(&row) {
            if let Some(column) = column {
                column.push(*value);
            }
        }
    }
    columns
}

/// Whether a base parameter of the closed form is in a joint's row at all: joint 3 does not depend on
/// links 1 and 2, joint 2 not on link 1 (eq. (5)).
fn counts(joint: usize, k: usize) -> bool {
    const FIRST_OF_LINK_2: usize = 1;
    const FIRST_OF_LINK_3: usize = 8;
    match joint {
        0 => k < COUNT,
        1 => k >= FIRST_OF_LINK_2,
        _ => k >= FIRST_OF_LINK_3,
    }
}
