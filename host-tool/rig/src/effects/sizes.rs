//! How large effects are drawn for a blind trial.

use std::f64::consts::{PI, TAU};

use model::{Posture, Robot};

use super::random::Random;

/// What the sizes of effects depend on.
#[derive(Clone, Copy, Debug)]
pub struct DrawContext<'a> {
    /// The true robot.
    pub robot: &'a Robot<f64>,
    /// Largest command of each joint in the excitation without any effect [V].
    pub peak_command_v: [f64; 3],
    /// The joint (0 to 2) that the effect acts on; 0 for the whole robot.
    pub joint: usize,
}

impl DrawContext<'_> {
    /// Stiffness, damping and motor inertia of a spring by the resonance of the link while the
    /// motor is held, 1/2 pi sqrt(k / J).
    pub fn spring(&self, random: &mut dyn Random, lowest_hz: f64, highest_hz: f64) -> [f64; 3] {
        let own_kg_m2 = self.own_inertia_kg_m2();
        let motor_kg_m2 = random.uniform(0.05, 0.3) * own_kg_m2;
        let link_kg_m2 = own_kg_m2 - motor_kg_m2;
        let frequency = TAU * random.log_uniform(lowest_hz, highest_hz);
        let damping_ratio = random.log_uniform(0.02, 0.1);
        [
            link_kg_m2 * frequency * frequency,
            2.0 * damping_ratio * link_kg_m2 * frequency,
            motor_kg_m2,
        ]
    }

    /// The joint's own entry of the mass matrix while the arm hangs, less what the links
    /// beyond the next joint add to it [kg m^2].
    fn own_inertia_kg_m2(&self) -> f64 {
        let base = &self.robot.base;
        let hanging = Posture::new(-0.5 * PI, 0.0);
        let whole = hanging.mass_matrix(base, &self.robot.geometry)[0][0];
        [whole, base.zz2r, base.zz3r + base.ia3][self.joint]
    }
}

/// Amplitude, harmonic and phase.
pub fn harmonic(random: &mut dyn Random, amplitude: [f64; 2], highest: u32) -> Vec<f64> {
    let [least, most] = amplitude;
    vec![random.log_uniform(least, most), random.harmonic(highest), random.phase_rad()]
}
