//! What drives the joints along a measured motion: commands as they reach the motors, and what effects add to them.

use super::active_effects::{ActiveEffects, any_feels_load, at_rest};
use crate::logs::kinematics::Joints;

impl ActiveEffects<'_> {
    /// What drives a joint in the interval after each sample: the command as it reaches the motor, with the
    /// voltages and torques that effects on it and on the whole robot add [V].
    pub fn drive_v(&self, joint: usize) -> Vec<f64> {
        let on_joint = self.hypothesis.effects_on_drive_of(joint);
        let feels_load = any_feels_load(&on_joint);
        let mut effects = at_rest(on_joint, self.stretch.period_s);
        let k_t = &self.plant.torque_constant_nm_per_v;
        let count = k_t.len();
        let drive_v = |k: usize| {
            let joint_state = self.joint_state(k, feels_load);
            let mut command_v = self.command_v(k);
            let command_v = &mut command_v[..count];
            let mut torque_nm = Joints::default();
            let torque_nm = &mut torque_nm[..count];
            effects.iter_mut().for_each(|e| e.change_command(&joint_state, command_v));
            for effect in &effects {
                effect.add_voltage(&joint_state, command_v);
                effect.add_torque(&joint_state, &self.plant, torque_nm);
            }
            command_v[joint] + torque_nm[joint] / k_t[joint]
        };
        (0..self.stretch.len()).map(drive_v).collect()
    }

    /// How much of the commands reaches a motor, rms by rms about their means: what is added to them is no part of
    /// them, nor is what a motor's torque constant makes of them.
    pub fn command_gain(&self, joint: usize) -> f64 {
        let on_joint = self.hypothesis.effects_on_drive_of(joint);
        let feels_load = any_feels_load(&on_joint);
        let mut effects = at_rest(on_joint, self.stretch.period_s);
        let count = self.plant.joints();
        let (mut sent, mut reached) = (Spread::default(), Spread::default());
        for k in 0..self.stretch.len() {
            let mut command_v = self.command_v(k);
            let command_v = &mut command_v[..count];
            sent.add(command_v[joint]);
            let joint_state = self.joint_state(k, feels_load);
            effects.iter_mut().for_each(|e| e.change_command(&joint_state, command_v));
            reached.add(command_v[joint]);
        }
        reached.over(&sent) / self.motor_gain(joint)
    }

    /// The commands over the interval after a sample [V].
    fn command_v(&self, k: usize) -> Joints {
        let mut command_v = Joints::default();
        let both = command_v.iter_mut().zip(&self.stretch.command_v);
        both.for_each(|(value, signal)| *value = signal[k]);
        command_v
    }
}

/// How far values spread about their mean.
#[derive(Clone, Copy, Debug, Default)]
struct Spread {
    count: f64,
    sum: f64,
    squares: f64,
}

impl Spread {
    fn add(&mut self, value: f64) {
        self.count += 1.0;
        self.sum += value;
        self.squares += value * value;
    }

    fn variance(&self) -> f64 {
        (self.squares - self.sum * self.sum / self.count.max(1.0)).max(0.0)
    }

    /// This spread over another, rms by rms; 1 where that one is none.
    fn over(&self, other: &Self) -> f64 {
        let least = 1e-12 * other.squares;
        match other.variance() > least {
            true => (self.variance() / other.variance()).sqrt(),
            false => 1.0,
        }
    }
}
