//! What the motor gave less what the motion needed: the one equation of the diagnosis.
//!
//! For each joint, eq. (5) in volts: drive less friction less what the rigid body needs. The
//! motion is the measured one, but for links behind a spring: they move as the spring drives
//! them.

use std::borrow::Cow;
use std::sync::{Arc, OnceLock};

use model::{FrictionState, Posture};

use super::active_effects::{ActiveEffects, FRICTION_SLOPES};
use super::hypothesis::Hypothesis;
use super::motor_side::MotorSide;
use super::rigid_body::{Path, regressor_columns, torques};
use crate::criteria::FitCriteria;
use crate::logs::derived::Payload;
use crate::logs::intervals::at_samples;
use crate::logs::joint_dynamics::JointDynamics;
use crate::logs::kinematics::{Kinematics, Sines};
use crate::logs::stretch::Stretch;
use rig::Plant;
use rig::effects::{TableAxis, Transmission};
use rig::plant::Body;
use signal::derivative;

/// A hypothesis on one stretch. What costs time is computed once it is asked for.
pub struct Trial<'a> {
    pub(super) stretch: &'a Stretch,
    hypothesis: &'a Hypothesis,
    pub(super) criteria: &'a FitCriteria,
    effects: ActiveEffects<'a>,
    /// Joints (from 0) with a spring between motor and link.
    pub(super) springs: Vec<(usize, Transmission)>,
    /// What moves with the links: the rigid body without the motors of elastic joints; none where
    /// no joint is elastic.
    links: Option<Body>,
    /// The motors' side of the springs, where another trial has computed it.
    pub(super) motor_side: Option<&'a dyn MotorSide>,
    /// Motion of the links, where some are behind springs.
    pub(super) link: OnceLock<Kinematics>,
    /// Sines and cosines of the links' angles, where those move otherwise than measured.
    pub(super) postures: OnceLock<Vec<Posture<f64>>>,
    /// The same by joints, as a chain takes them.
    pub(super) sines: OnceLock<Vec<Sines>>,
    /// What drives each joint in the intervals [V].
    drive_v: Vec<OnceLock<Vec<f64>>>,
    /// What the rigid body needs at the samples [V].
    needed_v: OnceLock<Vec<Vec<f64>>>,
    /// What effects add to the last link of a chain.
    pub(super) payload: OnceLock<Option<Payload>>,
}

impl<'a> Trial<'a> {
    /// Prepares a hypothesis for a stretch.
    pub fn of(stretch: &'a Stretch, hypothesis: &'a Hypothesis, criteria: &'a FitCriteria) -> Self {
        Self::with_motor_side(stretch, hypothesis, criteria, None)
    }

    /// The same where the motors' side of the springs may be known from another hypothesis.
    pub fn with_motor_side(
        stretch: &'a Stretch,
        hypothesis: &'a Hypothesis,
        criteria: &'a FitCriteria,
        motor_side: Option<&'a dyn MotorSide>,
    ) -> Self {
        let effects = ActiveEffects::of(stretch, hypothesis);
        let joints = effects.plant.joints();
        let springs = effects.springs();
        let links = (!springs.is_empty()).then(|| {
            let mut links = effects.plant.body.clone();
            for (joint, spring) in &springs {
                links.remove_motor(*joint, spring.motor_inertia_kg_m2);
            }
            links
        });
        Self {
            stretch,
            hypothesis,
            criteria,
            effects,
            springs,
            links,
            motor_side,
            link: OnceLock::new(),
            postures: OnceLock::new(),
            sines: OnceLock::new(),
            drive_v: vec![OnceLock::new(); joints],
            needed_v: OnceLock::new(),
            payload: OnceLock::new(),
        }
    }

    /// What the motor of a joint (from 0) gave less what was needed, at the samples, in volts of the command
    /// as it was sent: whatever a motor makes of a volt, noise of its command stays what it is.
    pub fn residual(&self, joint: usize) -> Vec<f64> {
        self.residual_of_net(joint, &self.net(joint))
    }

    /// The same, by what drives the joint less friction [V].
    pub fn residual_of_net(&self, joint: usize, net_v: &[f64]) -> Vec<f64> {
        let (mut left, needed) = (self.given(joint, net_v), self.needed(joint));
        let gain = self.motor_gain(joint);
        left.iter_mut().zip(needed).for_each(|(left, needed)| *left -= needed / gain);
        left
    }

    /// The part of it that no rigid body is in: what drives the joint less friction and lag, at the samples, in volts of
    /// the command as it was sent.
    pub fn given(&self, joint: usize, net_v: &[f64]) -> Vec<f64> {
        let (gain, lag_s) = (self.motor_gain(joint), self.hypothesis.lag_s[joint]);
        let both = at_samples(net_v).into_iter().zip(self.command_slope(joint));
        both.map(|(given, slope)| given / gain - lag_s * slope).collect()
    }

    /// Voltage left for the rigid body in the interval after each sample: what drives the
    /// joint less friction [V].
    pub fn net(&self, joint: usize) -> Vec<f64> {
        let mut net = self.drive(joint);
        let friction = self.friction(joint, self.plant());
        net.iter_mut().zip(&friction).for_each(|(drive, friction)| *drive -= friction);
        net
    }

    /// What drives a joint in the interval after each sample: the command as it reaches the
    /// motor, with the voltages and torques that effects add [V].
    pub fn drive(&self, joint: usize) -> Vec<f64> {
        match self.hypothesis.is_bare() {
            true => self.stretch.command_v[joint].clone(),
            false => self.drive_v[joint].get_or_init(|| self.effects.drive_v(joint)).clone(),
        }
    }

    /// Torque that the motor of a joint gives of every command, in parts of what its torque constant says.
    pub fn motor_gain(&self, joint: usize) -> f64 {
        self.effects.motor_gain(joint)
    }

    /// The commands of a joint as they reach its motor in the interval after each sample [V]; none where no effect
    /// changes them.
    pub fn reached_v(&self, joint: usize) -> Option<Vec<f64>> {
        let is_changed = !self.hypothesis.effects_on_drive_of(joint).is_empty();
        is_changed.then(|| self.effects.reached_v(joint))
    }

    /// Friction of a plant's joint in the interval after each sample [V].
    pub fn friction(&self, joint: usize, plant: &Plant) -> Vec<f64> {
        self.effects.friction_v(joint, plant)
    }

    /// Slopes of a joint's friction: along each of its parameters, along its lead, and along the gears' loss.
    pub fn friction_slopes(&self, joint: usize) -> Vec<[f64; FRICTION_SLOPES]> {
        self.effects.friction_slopes(joint)
    }

    /// Slopes of a joint's friction along the parts of its warmth, by those along its parameters [V].
    pub fn warmth_slopes(&self, joint: usize, slopes: &[[f64; FRICTION_SLOPES]]) -> [Vec<f64>; 2] {
        self.effects.warmth_slopes(joint, slopes)
    }

    /// The log that it is on.
    pub fn log(&self) -> usize {
        self.stretch.log
    }

    /// Voltage that the rigid body needs at the samples, eq. (5).
    pub fn needed(&self, joint: usize) -> &[f64] {
        &self.needed_v.get_or_init(|| self.needed_by_all())[joint]
    }

    fn needed_by_all(&self) -> Vec<Vec<f64>> {
        let mut needed_v = self.torques_nm();
        for (joint, spring) in &self.springs {
            let own = &self.motor().qdd_rad_per_s2[*joint];
            let both = needed_v[*joint].iter_mut().zip(own);
            both.for_each(|(torque_nm, qdd)| *torque_nm += spring.motor_inertia_kg_m2 * qdd);
        }
        for (needed, k_t) in needed_v.iter_mut().zip(&self.plant().torque_constant_nm_per_v) {
            needed.iter_mut().for_each(|torque_nm| *torque_nm /= k_t);
        }
        if let Some(payload) = self.payload() {
            for (joint, needed) in needed_v.iter_mut().enumerate() {
                let more = self.needed_by(&payload, joint);
                needed.iter_mut().zip(more).for_each(|(needed, more)| *needed += more);
            }
        }
        needed_v
    }

    /// Torques that the links' motion needs, a payload on a chain apart [Nm].
    fn torques_nm(&self) -> Vec<Vec<f64>> {
        if self.payload().is_none() {
            return torques(self.links(), self.path());
        }
        let given = self.given_body();
        let make = || torques(given, self.path());
        self.stretch.derived.torques.of(given, make).to_vec()
    }

    /// The rigid body of the model without what effects change of it.
    pub(super) fn given_body(&self) -> &Body {
        &self.hypothesis.plant.body
    }

    /// Whether any effect touches the rigid body or how it moves.
    pub(super) fn effects_touch_body(&self) -> bool {
        self.hypothesis.effects.iter().any(|effect| effect.definition.touches.body)
    }

    /// Columns of a joint's row of the regressor at the samples, in volts per unit of the base
    /// parameter; none where the joint does not depend on it.
    pub fn regressor_columns(&self, joint: usize) -> Vec<Option<Vec<f64>>> {
        let k_t = self.plant().torque_constant_nm_per_v[joint];
        let mut columns = regressor_columns(self.links(), joint, self.path());
        for column in columns.iter_mut().flatten() {
            column.iter_mut().for_each(|value| *value /= k_t);
        }
        columns
    }

    /// What moves with the links.
    fn links(&self) -> &Body {
        self.links.as_ref().unwrap_or(&self.plant().body)
    }

    fn path(&self) -> Path<'_> {
        let sines = if self.plant().body.as_rrr().is_some() { &[] } else { self.sines() };
        Path { motion: self.link(), postures: self.postures(), sines }
    }

    /// Change of the command per second, at the samples [V/s].
    pub fn command_slope(&self, joint: usize) -> Vec<f64> {
        derivative::first(&at_samples(&self.stretch.command_v[joint]), self.stretch.period_s)
    }

    /// Where on an axis a joint is in the interval after each sample, in the axis' unit.
    pub fn abscissa(&self, joint: usize, axis: TableAxis) -> Vec<f64> {
        self.effects.abscissa(joint, axis)
    }

    /// The plant with what effects change in it.
    pub fn plant(&self) -> &Plant {
        &self.effects.plant
    }

    /// Motion of the motors.
    pub fn motor(&self) -> &Kinematics {
        &self.effects.motor
    }

    /// How far the bristles of each joint are bent at every sample.
    pub fn bristles(&self) -> Vec<Vec<FrictionState<f64>>> {
        self.effects.bristles()
    }

    /// Load c + h on a joint at the samples [Nm].
    pub fn load_nm(&self, joint: usize) -> Vec<f64> {
        self.effects.load_nm(joint)
    }

    /// The same at every so many samples [Nm].
    pub fn load_at_every_nm(&self, joint: usize, samples: usize) -> Vec<f64> {
        self.effects.load_at_every_nm(joint, samples)
    }

    /// Whether the links move as the encoders tell.
    pub fn moves_as_measured(&self) -> bool {
        self.springs.is_empty() && self.has_true_encoders()
    }

    /// Whether the motors move as the encoders tell.
    pub(super) fn has_true_encoders(&self) -> bool {
        matches!(self.effects.motor, Cow::Borrowed(_))
    }

    /// Whether they do, and the rigid body is the model's own but for a payload.
    pub fn has_measured_body(&self) -> bool {
        self.moves_as_measured() && (!self.effects_touch_body() || self.payload().is_some())
    }

    /// Base parameters or coordinates of the rigid body.
    pub fn bases(&self) -> Vec<f64> {
        let plant = self.plant();
        (0..plant.base_count()).map(|index| plant.base(index)).collect()
    }

    /// Dynamics of a joint as if it were stiff, at the samples.
    pub fn dynamics(&self, joint: usize) -> Arc<Vec<JointDynamics>> {
        let body = &self.plant().body;
        let make = || JointDynamics::along(joint, self.motor(), &self.motor_sines(), body);
        match self.has_true_encoders() {
            true => self.stretch.derived.dynamics[joint].of(body, make),
            false => Arc::new(make()),
        }
    }
}
