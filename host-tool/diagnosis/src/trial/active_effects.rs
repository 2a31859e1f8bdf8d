//! The effects of a hypothesis, acting along the measured motion of a stretch.
//!
//! They are those of the simulator: what changes the command is applied to the recorded
//! command, what adds torque or friction is added, what changes the encoder's reading is
//! undone. Commands are recorded without noise, so nothing is inverted that would amplify it.

use std::borrow::Cow;

use model::friction::FrictionScale;
use model::{FrictionState, Posture, Robot};

use super::hypothesis::Hypothesis;
use super::reading;
use crate::logs::stretch::{Kinematics, Stretch};
use rig::effects::{Effect, JointState, Transmission};
use signal::derivative;

/// The effects of a hypothesis on a stretch.
pub struct ActiveEffects<'a> {
    stretch: &'a Stretch,
    hypothesis: &'a Hypothesis,
    effects: Vec<Box<dyn Effect>>,
    /// The robot with what effects change in it, motors of elastic joints included.
    pub robot: Robot<f64>,
    /// Motion of the motors: borrowed from the stretch where the encoders read true.
    pub motor: Cow<'a, Kinematics>,
}

impl<'a> ActiveEffects<'a> {
    /// Those of a hypothesis, none of which has acted yet.
    pub fn of(stretch: &'a Stretch, hypothesis: &'a Hypothesis) -> Self {
        let effects = hypothesis.built_effects();
        let mut robot = hypothesis.robot;
        effects.iter().for_each(|effect| effect.change_robot(&mut robot));
        let motor = reading::corrected(&stretch.motion, &effects);
        Self { stretch, hypothesis, effects, robot, motor }
    }

    /// Joints (0 to 2) with a spring between motor and link.
    pub fn springs(&self) -> Vec<(usize, Transmission)> {
        self.effects.iter().filter_map(|effect| effect.transmission()).collect()
    }

    /// What drives each joint in the interval after each sample: the command as it reaches the
    /// motor, with the voltages and torques that effects add [V].
    pub fn drive_v(&self) -> [Vec<f64>; 3] {
        // Lags and delays remember: each pass over a stretch begins with effects that do not.
        let mut effects = self.hypothesis.built_effects();
        effects.iter_mut().for_each(|effect| effect.set_step(self.stretch.period_s));
        let k_t = self.robot.torque_constant_nm_per_v;
        let mut drive_v = [0, 1, 2].map(|_| Vec::with_capacity(self.stretch.len()));
        for k in 0..self.stretch.len() {
            let joint_state = self.joint_state(k);
            let mut command_v = [0, 1, 2].map(|i| self.stretch.command_v[i][k]);
            let mut torque_nm = [0.0; 3];
            effects.iter_mut().for_each(|e| e.change_command(&joint_state, &mut command_v));
            for effect in &effects {
                effect.add_voltage(&joint_state, &mut command_v);
                effect.add_torque(&joint_state, &self.robot, &mut torque_nm);
            }
            (0..3).for_each(|i| drive_v[i].push(command_v[i] + torque_nm[i] / k_t[i]));
        }
        drive_v
    }

    /// Friction of a joint of `robot` in the interval after each sample [V].
    pub fn friction_v(&self, joint: usize, robot: &Robot<f64>) -> Vec<f64> {
        self.friction_ahead_v(joint, robot, self.hypothesis.friction_lead_s[joint])
    }

    /// The same of friction that runs ahead of the velocity by `lead_s`.
    pub fn friction_ahead_v(&self, joint: usize, robot: &Robot<f64>, lead_s: f64) -> Vec<f64> {
        let friction = &robot.friction[joint];
        let half_s = 0.5 * self.stretch.period_s;
        let v = self.velocity_ahead(joint, lead_s);
        let last = v.len() - 1;
        let mut bristles = FrictionState::default();
        let mut interval = |k: usize| {
            let scale = self.friction_scale(k)[joint];
            let (here, next) = (v[k], v[(k + 1).min(last)]);
            let (early, late) = (0.75 * here + 0.25 * next, 0.25 * here + 0.75 * next);
            0.5 * (bristles.step_scaled(friction, scale, early, half_s)
                + bristles.step_scaled(friction, scale, late, half_s))
        };
        (0..v.len()).map(&mut interval).collect()
    }

    /// Velocity that friction feels: to first order the one `lead_s` later [rad/s].
    fn velocity_ahead(&self, joint: usize, lead_s: f64) -> Cow<'_, [f64]> {
        let v = &self.motor.qd_rad_per_s[joint];
        if lead_s == 0.0 {
            return Cow::Borrowed(v);
        }
        let slope = derivative::first(v, self.stretch.period_s);
        Cow::Owned(v.iter().zip(slope).map(|(v, slope)| v + lead_s * slope).collect())
    }

    /// How far the bristles of each joint are bent at every sample.
    pub fn bristles(&self) -> Vec<[FrictionState<f64>; 3]> {
        let mut bristles = [FrictionState::default(); 3];
        let mut at = |k: usize| {
            let before = bristles;
            let scale = self.friction_scale(k);
            for (joint, state) in bristles.iter_mut().enumerate() {
                let v = self.motor.qd_rad_per_s[joint][k];
                let friction = &self.robot.friction[joint];
                state.step_scaled(friction, scale[joint], v, self.stretch.period_s);
            }
            before
        };
        (0..self.stretch.len()).map(&mut at).collect()
    }

    /// By how much effects scale each joint's friction in an interval.
    fn friction_scale(&self, k: usize) -> [FrictionScale<f64>; 3] {
        let mut scale = [FrictionScale::unchanged(); 3];
        if !self.effects.is_empty() {
            let joint_state = self.joint_state(k);
            self.effects.iter().for_each(|e| e.change_friction(&joint_state, &mut scale));
        }
        scale
    }

    /// The middle of an interval, as effects see it.
    fn joint_state(&self, k: usize) -> JointState {
        let next = (k + 1).min(self.stretch.len() - 1);
        let middle =
            |signal: &[Vec<f64>; 3]| [0, 1, 2].map(|i| 0.5 * (signal[i][k] + signal[i][next]));
        let q_rad = middle(&self.motor.q_rad);
        let qd_rad_per_s = middle(&self.motor.qd_rad_per_s);
        let load_nm = match self.effects.iter().any(|effect| effect.feels_load()) {
            true => load_nm(&self.robot, &q_rad, &qd_rad_per_s),
            false => [0.0; 3],
        };
        JointState {
            time_s: self.stretch.start_s + (k as f64 + 0.5) * self.stretch.period_s,
            q_rad,
            qd_rad_per_s,
            load_nm,
        }
    }

    /// Load c + h on a joint at the samples [Nm].
    pub fn load_nm(&self, joint: usize) -> Vec<f64> {
        let at = |k: usize| {
            let (q, qd, _) = self.motor.state(k);
            load_nm(&self.robot, &q, &qd)[joint]
        };
        (0..self.stretch.len()).map(at).collect()
    }
}

/// Coriolis and gravity torque on each joint, c + h of eq. (5) [Nm].
fn load_nm(robot: &Robot<f64>, q_rad: &[f64; 3], qd_rad_per_s: &[f64; 3]) -> [f64; 3] {
    let posture = Posture::new(q_rad[1], q_rad[2]);
    let coriolis = posture.coriolis(&robot.base, &robot.geometry, qd_rad_per_s);
    let gravity = posture.gravity(&robot.base, &robot.geometry);
    [0, 1, 2].map(|i| coriolis[i] + gravity[i])
}
