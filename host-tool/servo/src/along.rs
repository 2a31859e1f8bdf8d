//! What the rigid body asks of every joint along a measured motion.
//!
//! A joint's own position enters its gravity alone, as P cos x + S sin x of the distance x from
//! where the motion has it; the inertia about it depends on the joints behind it. So one joint can be
//! simulated while the others move as measured.

use model::chain::SerialChain;
use model::mechanism::{JointKind, Mechanism};

use crate::along_row::AlongRow;
use crate::moves::Moves;

/// The chain without rotors, which are the joints' own.
pub fn without_rotors(chain: &SerialChain<f64>) -> SerialChain<f64> {
    let mut links = *chain;
    for joint in 0..chain.joints().count() {
        *links.link_mut(joint).1 = 0.0;
    }
    links
}

/// The rigid body along a motion: by joint, then by row. `links` has no rotors.
pub fn along(links: &SerialChain<f64>, moves: &[Moves]) -> Vec<Vec<AlongRow>> {
    let n = moves.len();
    let rows = moves.first().map_or(0, |joint| joint.position.len());
    let mut found = vec![Vec::with_capacity(rows); n];
    let mut scratch = Scratch::of(n);
    for row in 0..rows {
        for (joint, along) in scratch.row(links, moves, row).enumerate() {
            found[joint].push(along);
        }
    }
    found
}

/// Memory for one row.
struct Scratch {
    q: Vec<f64>,
    qd: Vec<f64>,
    qdd: Vec<f64>,
    gravity: Vec<f64>,
    torque: Vec<f64>,
    turned: Vec<f64>,
    mass: Vec<f64>,
    rows: Vec<AlongRow>,
}

impl Scratch {
    fn of(n: usize) -> Self {
        let zeros = || vec![0.0; n];
        Self {
            q: zeros(),
            qd: zeros(),
            qdd: zeros(),
            gravity: zeros(),
            torque: zeros(),
            turned: zeros(),
            mass: vec![0.0; n * n],
            rows: vec![AlongRow::default(); n],
        }
    }

    fn row(
        &mut self,
        links: &SerialChain<f64>,
        moves: &[Moves],
        row: usize,
    ) -> impl Iterator<Item = AlongRow> + '_ {
        for (joint, track) in moves.iter().enumerate() {
            self.q[joint] = track.position[row] + track.turn;
            self.qd[joint] = track.velocity[row];
            self.qdd[joint] = track.acceleration[row];
        }
        links.gravity(&self.q, &mut self.gravity);
        links.inverse_dynamics(&self.q, &self.qd, &self.qdd, &mut self.torque);
        links.mass_matrix(&self.q, &mut self.mass);
        for joint in 0..self.q.len() {
            self.rows[joint] = self.joint(links, joint);
        }
        self.rows.iter().copied()
    }

    fn joint(&mut self, links: &SerialChain<f64>, joint: usize) -> AlongRow {
        let n = self.q.len();
        let (inertia, here) = (self.mass[joint * n + joint], self.gravity[joint]);
        let position = self.q[joint];
        let coupling = self.torque[joint] - here - inertia * self.qdd[joint];
        if links.kind(joint) == JointKind::Prismatic {
            return AlongRow { inertia, position, constant: here, coupling, ..AlongRow::default() };
        }
        // Of the moment of what the joint carries only the part across its axis makes torque, and turns.
        let slope = self.gravity_at(links, joint, std::f64::consts::FRAC_PI_2);
        AlongRow { inertia, position, gravity: here, slope, constant: 0.0, coupling }
    }

    /// Gravity's torque with the joint turned by an angle.
    fn gravity_at(&mut self, links: &SerialChain<f64>, joint: usize, angle: f64) -> f64 {
        let here = self.q[joint];
        self.q[joint] = here + angle;
        links.gravity(&self.q, &mut self.turned);
        self.q[joint] = here;
        self.turned[joint]
    }
}
