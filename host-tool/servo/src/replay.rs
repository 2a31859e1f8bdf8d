//! One joint simulated along a record, without feedback, from the recorded goals.

use crate::along_row::AlongRow;
use crate::joint::ServoJoint;
use crate::record::Record;
use crate::step::State;

/// A joint's simulated motion at the rows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Replay {
    /// Positions [rad; m].
    pub q: Vec<f64>,
    /// Velocities [rad/s; m/s].
    pub v: Vec<f64>,
    /// Voltage of the drive [V].
    pub volts: Vec<f64>,
}

/// Simulates a joint (from 0) while the others move as measured, in steps of at most `step_s`.
pub fn replay(
    servo: &ServoJoint,
    record: &Record,
    joint: usize,
    along: &[AlongRow],
    step_s: f64,
) -> Replay {
    let track = &record.joints[joint];
    let turn = servo.encoder_offset;
    let mut found = Replay::with_capacity(record.len());
    // The first position was read some time after the first goal was sent.
    let first = track.position[0] - servo.read_after_s * track.velocity[0];
    let mut state = State { q: first, v: track.velocity[0], ..State::default() };
    // At rest a motor holds its load.
    state.u = servo.stiffness * (track.goal[0] - state.q);
    for row in 0..record.len() {
        found.push(&state);
        if row + 1 == record.len() {
            break;
        }
        let (from, to) = (record.time_s[row], record.time_s[row + 1]);
        let steps = ((to - from) / step_s - 1e-3).ceil().max(1.0);
        let h = (to - from) / steps;
        for k in 0..steps as usize {
            let load = along[row].load(state.q - along[row].position + turn, servo.gravity);
            state = servo.step(&state, track.goal[row], &load, h, from + k as f64 * h);
        }
    }
    found
}

impl Replay {
    /// Room for rows.
    pub fn with_capacity(rows: usize) -> Self {
        let room = || Vec::with_capacity(rows);
        Self { q: room(), v: room(), volts: room() }
    }

    /// One more row.
    pub fn push(&mut self, state: &State) {
        self.q.push(state.q);
        self.v.push(state.v);
        self.volts.push(state.u);
    }

    /// What the log would read: the position `after_s` seconds after each row, behind a play.
    pub fn read(&self, time_s: &[f64], after_s: f64, gap: f64) -> Vec<f64> {
        let mut read = self.positions(time_s, after_s);
        if gap > 0.0 {
            let mut behind = read[0];
            for q in &mut read {
                behind = behind.clamp(*q - 0.5 * gap, *q + 0.5 * gap);
                *q = behind;
            }
        }
        read
    }

    fn positions(&self, time_s: &[f64], after_s: f64) -> Vec<f64> {
        let mut row = 0;
        let last = time_s.len() - 1;
        let at = |now: &f64| {
            let then = now + after_s;
            while row + 2 <= last && time_s[row + 1] <= then {
                row += 1;
            }
            while row > 0 && time_s[row] > then {
                row -= 1;
            }
            self.between(time_s, row, then)
        };
        time_s.iter().map(at).collect()
    }

    /// Hermite's cubic between a row and the next; on from the last row's velocity, the first row's position before it.
    fn between(&self, time_s: &[f64], row: usize, then: f64) -> f64 {
        let (last, first) = (time_s.len() - 1, time_s[0]);
        if row + 1 > last || then <= first {
            return self.q[row];
        }
        if then > time_s[last] {
            return self.q[last] + self.v[last] * (then - time_s[last]);
        }
        let h = time_s[row + 1] - time_s[row];
        let x = (then - time_s[row]) / h;
        let (q, v) = (&self.q[row..row + 2], &self.v[row..row + 2]);
        let y = 1.0 - x;
        let ends = q[0] * y * y * (1.0 + 2.0 * x) + q[1] * x * x * (3.0 - 2.0 * x);
        ends + h * x * y * (v[0] * y - v[1] * x)
    }
}
