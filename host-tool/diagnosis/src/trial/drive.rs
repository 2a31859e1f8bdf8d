//! What drives the joints along a measured motion: commands as they reach the motors, and what effects add to them.

use super::active_effects::{ActiveEffects, TorquesFelt, at_rest};
use crate::logs::kinematics::Joints;

impl ActiveEffects<'_> {
    /// What drives a joint in the interval after each sample: the command as it reaches the motor, with the
    /// voltages and torques that effects on it and on the whole robot add [V].
    pub fn drive_v(&self, joint: usize) -> Vec<f64> {
        let mut drive_v = self.own_drive_v(joint);
        let k_t = self.plant.torque_constant_nm_per_v[joint];
        if let Some(outside_nm) = self.torque_from_outside_nm().get(joint) {
            drive_v.iter_mut().zip(outside_nm).for_each(|(drive, torque)| *drive += torque / k_t);
        }
        drive_v
    }

    /// The part of it that is of the joint's own drive and effects [V].
    fn own_drive_v(&self, joint: usize) -> Vec<f64> {
        let on_joint = self.hypothesis.effects_on_drive_of(joint);
        if on_joint.is_empty() {
            return self.stretch.command_v[joint].clone();
        }
        let felt = TorquesFelt::by(&on_joint);
        let mut effects = at_rest(on_joint, self.stretch.period_s);
        let k_t = &self.plant.torque_constant_nm_per_v;
        let count = k_t.len();
        let drive_v = |k: usize| {
            let joint_state = self.joint_state(k, felt);
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

    /// Torques that effects on the whole robot add in the interval after each sample, by joints: of all at once, for each
    /// needs the posture of the whole arm; none without such effects [Nm; N]. They change neither commands nor voltages.
    fn torque_from_outside_nm(&self) -> &[Vec<f64>] {
        self.from_outside_nm.get_or_init(|| {
            let effects = at_rest(self.hypothesis.effects_from_outside(), self.stretch.period_s);
            if effects.is_empty() {
                return Vec::new();
            }
            let felt = TorquesFelt::by(&effects);
            let mut by_joints = vec![Vec::with_capacity(self.stretch.len()); self.plant.joints()];
            for k in 0..self.stretch.len() {
                let (joint_state, mut torque_nm) = (self.joint_state(k, felt), Joints::default());
                let torque_nm = &mut torque_nm[..by_joints.len()];
                effects.iter().for_each(|e| e.add_torque(&joint_state, &self.plant, torque_nm));
                by_joints.iter_mut().zip(torque_nm).for_each(|(all, torque)| all.push(*torque));
            }
            by_joints
        })
    }

    /// The commands of a joint as they reach its motor in the interval after each sample: without what is added to
    /// them, which is no part of them [V].
    pub fn reached_v(&self, joint: usize) -> Vec<f64> {
        let on_joint = self.hypothesis.effects_on_drive_of(joint);
        let felt = TorquesFelt::by(&on_joint);
        let mut effects = at_rest(on_joint, self.stretch.period_s);
        let count = self.plant.joints();
        let reached_v = |k: usize| {
            let joint_state = self.joint_state(k, felt);
            let mut command_v = self.command_v(k);
            let command_v = &mut command_v[..count];
            effects.iter_mut().for_each(|e| e.change_command(&joint_state, command_v));
            command_v[joint]
        };
        (0..self.stretch.len()).map(reached_v).collect()
    }

    /// The commands over the interval after a sample [V].
    fn command_v(&self, k: usize) -> Joints {
        let mut command_v = Joints::default();
        let both = command_v.iter_mut().zip(&self.stretch.command_v);
        both.for_each(|(value, signal)| *value = signal[k]);
        command_v
    }
}
