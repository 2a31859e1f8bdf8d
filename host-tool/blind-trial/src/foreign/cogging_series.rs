//! Cogging as a geared motor has it: overtones, and an order that is not an integer.

use std::f64::consts::TAU;

use super::definition::Definition;
use rig::effects::{Effect, JointState};

pub(super) const DEFINITION: Definition = Definition {
    name: "cogging_series",
    words: "the magnets pull in a wave that is no sine, seen through a gear: \
            u + A sum a_k sin(k n q + phi_k), n not an integer",
    resembles: &["cogging", "torque_ripple"],
    equivalent: &["cogging"],
    grows: true,
    parameters: &[
        "amplitude_V",
        "order",
        "phase_rad",
        "second",
        "third",
        "phase2_rad",
        "phase3_rad",
    ],
    draw: |_, random| {
        let order = match random.unit() < 0.5 {
            true => random.harmonic(24),
            false => random.uniform(1.5, 40.0),
        };
        let [second, third] = [random.uniform(0.0, 0.6), random.uniform(0.0, 0.4)];
        let amplitude_v = random.log_uniform(0.03, 0.2);
        let phases = [(); 3].map(|()| random.phase_rad());
        vec![amplitude_v, order, phases[0], second, third, phases[1], phases[2]]
    },
    build: |joint, values| {
        Box::new(CoggingSeries {
            joint,
            order: values[1],
            amplitudes_v: [1.0, values[3], values[4]].map(|part| values[0] * part),
            phases_rad: [values[2], values[5], values[6]],
        })
    },
};

#[derive(Clone, Debug)]
struct CoggingSeries {
    joint: usize,
    order: f64,
    amplitudes_v: [f64; 3],
    phases_rad: [f64; 3],
}

impl Effect for CoggingSeries {
    fn add_voltage(&self, state: &JointState, voltage_v: &mut [f64]) {
        // On the whole turn of the motor, whatever the turn of the joint.
        let angle = (self.order * state.q_rad[self.joint]) % TAU;
        for (k, (amplitude_v, phase)) in (1..).zip(self.amplitudes_v.iter().zip(self.phases_rad)) {
            voltage_v[self.joint] += amplitude_v * (f64::from(k) * angle + phase).sin();
        }
    }
}
