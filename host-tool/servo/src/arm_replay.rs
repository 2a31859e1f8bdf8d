//! The whole arm simulated along a record, without feedback, from the recorded goals.

use model::chain::SerialChain;
use model::mechanism::Mechanism;

use crate::joint::ServoJoint;
use crate::record::Record;
use crate::replay::Replay;
use crate::step::{Load, State};

/// Simulates all joints together in steps of at most `step_s`; `links` has no rotors, `force_n` acts
/// on the tip, base frame.
///
/// Joints feel each other's accelerations: Gauss and Seidel's sweeps over them, which converge for
/// a mass matrix is positive definite.
pub fn arm_replay(
    links: &SerialChain<f64>,
    force_n: [f64; 3],
    servos: &[ServoJoint],
    record: &Record,
    step_s: f64,
) -> Vec<Replay> {
    let tracks = record.joints.iter();
    let start = tracks.zip(servos).map(|(track, servo)| {
        let v = track.velocity[0];
        let q = track.position[0] - servo.read_after_s * v;
        State { q, v, u: servo.stiffness * (track.goal[0] - q) }
    });
    let mut arm = Arm::of(links, servos, start.collect());
    arm.force_n = force_n;
    let mut found = vec![Replay::with_capacity(record.len()); servos.len()];
    for row in 0..record.len() {
        found.iter_mut().zip(&arm.states).for_each(|(joint, state)| joint.push(state));
        let Some(next) = record.time_s.get(row + 1) else { break };
        let from = record.time_s[row];
        let steps = ((next - from) / step_s - 1e-3).ceil().max(1.0);
        let h = (next - from) / steps;
        for k in 0..steps as usize {
            arm.step(|joint| record.joints[joint].goal[row], h, from + k as f64 * h);
        }
    }
    found
}

/// An arm in motion.
pub struct Arm<'a> {
    links: &'a SerialChain<f64>,
    servos: &'a [ServoJoint],
    /// The joints' states.
    pub states: Vec<State>,
    /// A force that always acts on the tip, base frame [N].
    pub force_n: [f64; 3],
    acceleration: Vec<f64>,
    q: Vec<f64>,
    v: Vec<f64>,
    zero: Vec<f64>,
    gravity: Vec<f64>,
    bias: Vec<f64>,
    mass: Vec<f64>,
}

impl<'a> Arm<'a> {
    /// An arm in these states; `links` has no rotors.
    pub fn of(links: &'a SerialChain<f64>, servos: &'a [ServoJoint], states: Vec<State>) -> Self {
        let n = servos.len();
        let zeros = || vec![0.0; n];
        Self {
            links,
            servos,
            states,
            force_n: [0.0; 3],
            acceleration: zeros(),
            q: zeros(),
            v: zeros(),
            zero: zeros(),
            gravity: zeros(),
            bias: zeros(),
            mass: vec![0.0; n * n],
        }
    }

    /// A step of `h` seconds towards goals by joint, `t_s` seconds into the log.
    pub fn step(&mut self, goal: impl Fn(usize) -> f64, h: f64, t_s: f64) {
        const SWEEPS: usize = 2;
        let n = self.states.len();
        for (joint, state) in self.states.iter().enumerate() {
            self.q[joint] = state.q + self.servos[joint].encoder_offset;
            self.v[joint] = state.v;
        }
        self.links.gravity(&self.q, &mut self.gravity);
        self.links.inverse_dynamics(&self.q, &self.v, &self.zero, &mut self.bias);
        self.links.mass_matrix(&self.q, &mut self.mass);
        self.push_tip();
        let mut next = self.states.clone();
        for _ in 0..SWEEPS {
            for joint in 0..n {
                let servo = &self.servos[joint];
                let others = (0..n).filter(|other| *other != joint);
                let asked: f64 =
                    others.map(|k| self.mass[joint * n + k] * self.acceleration[k]).sum();
                let weight = (servo.gravity - 1.0) * self.gravity[joint];
                let load = Load {
                    inertia: self.mass[joint * n + joint],
                    torque: self.bias[joint] + weight + asked,
                    slope: 0.0,
                };
                next[joint] = servo.step(&self.states[joint], goal(joint), &load, h, t_s);
                self.acceleration[joint] = (next[joint].v - self.states[joint].v) / h;
            }
        }
        self.states = next;
    }

    /// Takes what the force on the tip does from what the motion asks: torque = J^T F.
    fn push_tip(&mut self) {
        if self.force_n == [0.0; 3] {
            return;
        }
        let n = self.states.len();
        let mut rows = vec![0.0; 6 * n];
        self.links.tip_jacobian(&self.q, &mut rows);
        for joint in 0..n {
            let given = |axis: usize| rows[axis * n + joint] * self.force_n[axis];
            self.bias[joint] -= (0..3).map(given).sum::<f64>();
        }
    }
}
