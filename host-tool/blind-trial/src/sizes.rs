//! How large the effects of the catalogue are drawn.

use std::f64::consts::{PI, TAU};

use model::{Posture, Robot};

use super::Rng;
use rig::effects::Definition;

/// What sizes depend on.
#[derive(Clone, Copy, Debug)]
pub struct Site<'a> {
    /// The true robot.
    pub robot: &'a Robot<f64>,
    /// Largest command of each joint in the excitation without any effect [V].
    pub peak_command_v: [f64; 3],
}

impl Site<'_> {
    /// Values of an effect's parameters in the definition's order, for a joint (1 to 3,
    /// or 0 for the whole robot).
    pub fn values(&self, definition: &Definition, joint: u8, rng: &mut Rng) -> Vec<f64> {
        let index = usize::from(joint.max(1)) - 1;
        match definition.name {
            "torque_constant" => vec![rng.signed_log_uniform(0.05, 0.2)],
            "actuator_lag" => vec![rng.log_uniform(1e-3, 1e-2)],
            "delay" => vec![rng.log_uniform(1e-3, 6e-3)],
            "position_friction" => wave(rng, 0.15, 0.5, 12),
            "cogging" => wave(rng, 0.03, 0.2, 24),
            "torque_ripple" => wave(rng, 0.03, 0.15, 24),
            "payload" => vec![rng.log_uniform(0.1, 1.0)],
            "tip_force" => force_n(rng),
            "base_tilt" => tilt_rad(rng),
            "joint_elasticity" => self.spring(index, rng, 8.0, 40.0),
            "backlash" => self.loose_spring(index, rng),
            "asymmetric_friction" => vec![rng.signed_log_uniform(0.1, 0.4)],
            "load_friction" => vec![self.load_friction_v_per_nm(index, rng)],
            "friction_drift" => vec![rng.signed_log_uniform(0.15, 0.6), rng.uniform(2.0, 10.0)],
            "cable_spring" => vec![rng.log_uniform(0.05, 0.5), rest_rad(index, rng)],
            "dac_offset" => vec![rng.signed_log_uniform(0.03, 0.2)],
            "saturation" => vec![rng.uniform(0.4, 0.95) * self.peak_command_v[index]],
            "dead_zone" => vec![rng.log_uniform(0.05, 0.3)],
            "encoder_eccentricity" => vec![rng.log_uniform(3e-3, 1.5e-2), rng.phase_rad()],
            "quadratic_drag" => vec![rng.log_uniform(0.003, 0.05)],
            // An effect that is new in the catalogue, small against its bounds.
            _ => definition.parameters.iter().map(|p| rng.uniform(0.0, 0.02) * p.highest).collect(),
        }
    }

    /// A spring by the resonance of the link while the motor is held, 1/2 pi sqrt(k / J).
    fn spring(&self, index: usize, rng: &mut Rng, lowest_hz: f64, highest_hz: f64) -> Vec<f64> {
        let own_kg_m2 = self.own_inertia_kg_m2(index);
        let motor_kg_m2 = rng.uniform(0.05, 0.3) * own_kg_m2;
        let link_kg_m2 = own_kg_m2 - motor_kg_m2;
        let frequency = TAU * rng.log_uniform(lowest_hz, highest_hz);
        let damping_ratio = rng.log_uniform(0.02, 0.1);
        vec![
            link_kg_m2 * frequency * frequency,
            2.0 * damping_ratio * link_kg_m2 * frequency,
            motor_kg_m2,
        ]
    }

    fn loose_spring(&self, index: usize, rng: &mut Rng) -> Vec<f64> {
        let gap_rad = rng.log_uniform(5e-4, 5e-3);
        let spring = self.spring(index, rng, 20.0, 60.0);
        [&[gap_rad], &spring[..]].concat()
    }

    /// The joint's own entry of the mass matrix while the arm hangs, less what the links
    /// beyond the next joint add to it [kg m^2].
    fn own_inertia_kg_m2(&self, index: usize) -> f64 {
        let base = &self.robot.base;
        let hanging = Posture::new(-0.5 * PI, 0.0);
        let whole = hanging.mass_matrix(base, &self.robot.geometry)[0][0];
        [whole, base.zz2r, base.zz3r + base.ia3][index]
    }

    /// In parts of the load in volts, so that joints are alike.
    fn load_friction_v_per_nm(&self, index: usize, rng: &mut Rng) -> f64 {
        rng.log_uniform(0.03, 0.3) / self.robot.torque_constant_nm_per_v[index]
    }
}

/// Amplitude, harmonic, phase.
fn wave(rng: &mut Rng, lowest: f64, highest: f64, highest_harmonic: u32) -> Vec<f64> {
    vec![rng.log_uniform(lowest, highest), rng.harmonic(highest_harmonic), rng.phase_rad()]
}

/// A force in any direction.
fn force_n(rng: &mut Rng) -> Vec<f64> {
    let (size_n, up) = (rng.log_uniform(1.0, 8.0), rng.uniform(-1.0, 1.0));
    let (sine, cosine) = rng.phase_rad().sin_cos();
    let level = (1.0 - up * up).sqrt();
    vec![size_n * level * cosine, size_n * level * sine, size_n * up]
}

/// A lean in any direction.
fn tilt_rad(rng: &mut Rng) -> Vec<f64> {
    let size_rad = rng.log_uniform(0.01, 0.1);
    let (sine, cosine) = rng.phase_rad().sin_cos();
    let hidden_kg_m = [rng.uniform(-1.0, 2.0), rng.uniform(-0.5, 0.5)];
    vec![size_rad * cosine, size_rad * sine, hidden_kg_m[0], hidden_kg_m[1]]
}

/// A rest angle near the posture about which motions are made [rad].
fn rest_rad(index: usize, rng: &mut Rng) -> f64 {
    [0.0, -0.5 * PI, 0.0][index] + rng.uniform(-1.0, 1.0)
}

#[cfg(test)]
mod tests {
    use model::reference_robot::reference_robot;

    use super::*;
    use rig::effects::CATALOGUE;

    #[test]
    fn every_effect_gets_values_within_its_bounds() {
        let robot = reference_robot();
        let site = Site { robot: &robot, peak_command_v: [2.0, 5.0, 3.0] };
        let mut rng = Rng::new(1, 1);
        for definition in CATALOGUE {
            for _ in 0..50 {
                let joint = if definition.whole_robot { 0 } else { rng.joint() };
                let values = site.values(definition, joint, &mut rng);
                definition.with(joint, &values).unwrap();
            }
        }
    }
}
