//! The effects of a hypothesis, acting along the measured motion of a stretch.
//!
//! They are those of the simulator: what changes the command is applied to the recorded
//! command, what adds torque or friction is added, what changes the encoder's reading is
//! undone. Commands are recorded without noise, so nothing is inverted that would amplify it.

use std::borrow::Cow;

use model::friction::FrictionScale;
use model::friction_parameters::COUNT as FRICTION_COUNT;
use model::{Dual, Friction, FrictionState, Posture, Real, Robot};

use super::hypothesis::Hypothesis;
use super::reading;
use crate::logs::stretch::{Kinematics, Stretch};
use rig::effects::{Effect, JointState, Table, TableAxis, Transmission};
use signal::derivative;

/// Slopes of friction: along its parameters, and along its lead.
pub const FRICTION_SLOPES: usize = FRICTION_COUNT + 1;

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

    /// How much of the commands reaches each motor, rms by rms.
    pub fn command_gain(&self) -> [f64; 3] {
        let mut effects = self.hypothesis.built_effects();
        effects.iter_mut().for_each(|effect| effect.set_step(self.stretch.period_s));
        let (mut sent, mut reached) = ([0.0; 3], [0.0; 3]);
        for k in 0..self.stretch.len() {
            let mut command_v = [0, 1, 2].map(|i| self.stretch.command_v[i][k]);
            (0..3).for_each(|i| sent[i] += command_v[i] * command_v[i]);
            let joint_state = self.joint_state(k);
            effects.iter_mut().for_each(|e| e.change_command(&joint_state, &mut command_v));
            (0..3).for_each(|i| reached[i] += command_v[i] * command_v[i]);
        }
        [0, 1, 2].map(|i| if sent[i] > 0.0 { (reached[i] / sent[i]).sqrt() } else { 1.0 })
    }

    /// Friction of a joint of `robot` in the interval after each sample [V].
    pub fn friction_v(&self, joint: usize, robot: &Robot<f64>) -> Vec<f64> {
        let lead_s = self.hypothesis.friction_lead_s[joint];
        self.friction_with(joint, &robot.friction[joint], lead_s, |friction_v| friction_v)
    }

    /// Slopes of a joint's friction in the interval after each sample: along each of its
    /// parameters, in their order, and along its lead [V per their unit].
    pub fn friction_slopes(&self, joint: usize) -> Vec<[f64; FRICTION_SLOPES]> {
        let mut place = 0;
        let mut along = |value: f64| {
            place += 1;
            Dual::along(value, place - 1)
        };
        let friction = Friction::from_array(self.robot.friction[joint].to_array().map(&mut along));
        let lead_s = along(self.hypothesis.friction_lead_s[joint]);
        self.friction_with(joint, &friction, lead_s, |friction_v| friction_v.slope)
    }

    /// A part of a joint's friction in the interval after each sample, were it `friction` and ahead
    /// of the velocity by `lead_s`.
    fn friction_with<T: Real, P>(
        &self,
        joint: usize,
        friction: &Friction<T>,
        lead_s: T,
        part: impl Fn(T) -> P,
    ) -> Vec<P> {
        let (half, quarter) = (T::constant(0.5), T::constant(0.25));
        let half_s = half * T::constant(self.stretch.period_s);
        let v = self.velocity_ahead(joint, lead_s);
        let last = v.len() - 1;
        let scaled = self.hypothesis.effects.iter().any(|e| e.definition.touches.friction);
        let mut bristles = FrictionState { deflection_rad: T::zero() };
        let mut interval = |k: usize| {
            let scale = match scaled {
                true => self.friction_scale(k)[joint].cast(),
                false => FrictionScale::unchanged(),
            };
            let (here, next) = (v[k], v[(k + 1).min(last)]);
            let quarter_on = (next - here) * quarter;
            let early = bristles.step_scaled(friction, scale, here + quarter_on, half_s);
            let late = bristles.step_scaled(friction, scale, next - quarter_on, half_s);
            part(half * (early + late))
        };
        (0..v.len()).map(&mut interval).collect()
    }

    /// Velocity that friction feels: to first order the one `lead_s` later [rad/s].
    fn velocity_ahead<T: Real>(&self, joint: usize, lead_s: T) -> Vec<T> {
        let v = &self.motor.qd_rad_per_s[joint];
        let slope = derivative::first(v, self.stretch.period_s);
        let ahead = |(v, slope): (&f64, f64)| T::constant(*v) + lead_s * T::constant(slope);
        v.iter().zip(slope).map(ahead).collect()
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

    /// Where on an axis a joint is in the interval after each sample, in the axis' unit.
    pub fn abscissa(&self, joint: usize, axis: TableAxis) -> Vec<f64> {
        let table = Table { joint: joint as u8 + 1, axis, knots: vec![], values_v: vec![] };
        let at = |k: usize| {
            let mut state = self.joint_state(k);
            if axis == TableAxis::Load {
                state.load_nm = load_nm(&self.robot, &state.q_rad, &state.qd_rad_per_s);
            }
            table.abscissa(&state, self.stretch.command_v[joint][k])
        };
        (0..self.stretch.len()).map(at).collect()
    }

    /// By how much effects scale each joint's friction in an interval.
    fn friction_scale(&self, k: usize) -> [FrictionScale<f64>; 3] {
        let mut scale = [FrictionScale::unchanged(); 3];
        let joint_state = self.joint_state(k);
        self.effects.iter().for_each(|e| e.change_friction(&joint_state, &mut scale));
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
        self.load_at_every_nm(joint, 1)
    }

    /// The same at every so many samples [Nm].
    pub fn load_at_every_nm(&self, joint: usize, samples: usize) -> Vec<f64> {
        let at = |k: usize| {
            let (q, qd, _) = self.motor.state(k);
            load_nm(&self.robot, &q, &qd)[joint]
        };
        (0..self.stretch.len()).step_by(samples).map(at).collect()
    }
}

/// Coriolis and gravity torque on each joint, c + h of eq. (5) [Nm].
fn load_nm(robot: &Robot<f64>, q_rad: &[f64; 3], qd_rad_per_s: &[f64; 3]) -> [f64; 3] {
    let posture = Posture::new(q_rad[1], q_rad[2]);
    let coriolis = posture.coriolis(&robot.base, &robot.geometry, qd_rad_per_s);
    let gravity = posture.gravity(&robot.base, &robot.geometry);
    [0, 1, 2].map(|i| coriolis[i] + gravity[i])
}
