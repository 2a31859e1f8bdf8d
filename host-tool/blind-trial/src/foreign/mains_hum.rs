//! Hum of the supply in the voltage.

use std::f64::consts::TAU;

use super::definition::Definition;
use rig::effects::{Effect, JointState};

pub(super) const DEFINITION: Definition = Definition {
    name: "mains_hum",
    words: "the supply hums: u + A sin(2 pi f t + phi), whatever the angle",
    resembles: &["cogging", "torque_ripple"],
    equivalent: &[],
    grows: true,
    parameters: &["amplitude_V", "frequency_Hz", "phase_rad"],
    draw: |_, random| {
        vec![random.log_uniform(0.03, 0.2), random.uniform(10.0, 50.0), random.phase_rad()]
    },
    build: |joint, values| {
        let (amplitude_v, frequency_hz, phase_rad) = (values[0], values[1], values[2]);
        Box::new(MainsHum { joint, amplitude_v, frequency_hz, phase_rad })
    },
};

#[derive(Clone, Debug)]
struct MainsHum {
    joint: usize,
    amplitude_v: f64,
    frequency_hz: f64,
    phase_rad: f64,
}

impl Effect for MainsHum {
    fn add_voltage(&self, state: &JointState, voltage_v: &mut [f64]) {
        let angle = TAU * self.frequency_hz * state.time_s + self.phase_rad;
        voltage_v[self.joint] += self.amplitude_v * angle.sin();
    }
}
