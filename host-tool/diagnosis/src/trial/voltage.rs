//! What the motor gave less what the motion needed: the one equation of the diagnosis.
//!
//! The effects are those of the simulator, met along the measured motion: what changes the
//! command is applied to the recorded command, what adds torque or friction is added, what
//! changes the encoder's reading is undone, and a link behind a spring moves as the spring
//! drives it. Commands are recorded without noise, so nothing is inverted that would amplify
//! noise.

use std::borrow::Cow;
use std::cell::OnceCell;
use std::f64::consts::{PI, TAU};

use model::friction::FrictionScale;
use model::{FrictionState, Posture, Robot};

use super::link_motion::{self, Felt, JointMotion};
use super::reading;
use crate::logs::stretch::{Kinematics, Stretch};
use rig::effects::Transmission;
use rig::effects::{Definition, Effect, JointState, Kind};
use signal::derivative;

/// An effect that is in a model under trial.
#[derive(Clone, Debug)]
pub struct EffectInstance {
    /// What it is.
    pub definition: &'static Definition,
    /// Joint, 1 to 3; 0 for the whole robot.
    pub joint: u8,
    /// Its parameters, in the order of the definition.
    pub values: Vec<f64>,
}

impl EffectInstance {
    /// The effect, its values kept within their bounds; `None` if it acts on no such joint.
    pub fn build(&self) -> Option<Box<dyn Effect>> {
        self.definition.with(self.joint, &self.bounded()).ok()
    }

    /// Whether it leaves play between a motor and its link.
    pub fn has_backlash(&self) -> bool {
        self.definition.parameters.iter().any(|parameter| parameter.kind == Kind::Gap)
    }

    /// Whether it is a spring between a motor and its link.
    pub fn is_spring(&self) -> bool {
        self.build().is_some_and(|effect| effect.transmission().is_some())
    }

    /// Turns a negative amplitude into half a turn of phase, and keeps values in bounds.
    pub fn normalise(&mut self) {
        let place = |kind| self.definition.parameters.iter().position(|p| p.kind == kind);
        if let (Some(amplitude), Some(phase)) = (place(Kind::Amplitude), place(Kind::Phase)) {
            if self.values[amplitude] < 0.0 {
                self.values[amplitude] = -self.values[amplitude];
                self.values[phase] += PI;
            }
            self.values[phase] -= TAU * (self.values[phase] / TAU).round();
        }
        self.values = self.bounded();
    }

    /// The values within their bounds.
    pub fn bounded(&self) -> Vec<f64> {
        let bounds = self.definition.parameters.iter();
        bounds.zip(&self.values).map(|(p, v)| v.clamp(p.lowest, p.highest)).collect()
    }
}

/// A model under trial.
#[derive(Clone, Debug)]
pub struct Hypothesis {
    /// Rigid body and friction.
    pub robot: Robot<f64>,
    /// By how much each command comes later than the log says [s].
    pub lag_s: [f64; 3],
    /// Effects, in order.
    pub effects: Vec<EffectInstance>,
}

impl Hypothesis {
    /// The same with one more effect.
    pub fn with(&self, effect: EffectInstance) -> Self {
        let mut hypothesis = self.clone();
        hypothesis.effects.push(effect);
        hypothesis
    }
}

/// A model under trial over one stretch: the motion as it sees it, and what is the same for
/// all joints.
pub struct Trial<'a> {
    stretch: &'a Stretch,
    hypothesis: &'a Hypothesis,
    same: Option<Same<'a>>,
    /// The robot with what effects change in it, motors of elastic joints included.
    robot: Robot<f64>,
    /// What moves with the links.
    links: Robot<f64>,
    /// Joints (0 to 2) with a spring between motor and link.
    springs: Vec<(usize, Transmission)>,
    /// Motion of the motors.
    motor: Cow<'a, Kinematics>,
    /// Motion of the links behind springs, once asked for.
    link: OnceCell<Kinematics>,
    /// Sines and cosines of the links' angles, where those move otherwise than measured.
    postures: OnceCell<Vec<Posture<f64>>>,
    /// What drives the joints in the intervals, once asked for [V].
    drive_v: OnceCell<[Vec<f64>; 3]>,
    /// Voltages that the rigid body needs at the samples, once asked for.
    needed_v: OnceCell<[Vec<f64>; 3]>,
    /// Whether an effect needs to know the load.
    feels_load: bool,
}

/// What a model shares with one that has another spring: the motors' motion and what drives
/// them.
#[derive(Clone, Copy, Debug)]
pub struct Same<'a> {
    /// What joints feel of the rest of the arm, by samples.
    pub felt: [&'a [Felt]; 3],
    /// What drives joints less friction, by intervals [V].
    pub net_v: [&'a [f64]; 3],
}

impl<'a> Trial<'a> {
    /// Prepares a model for a stretch.
    pub fn of(stretch: &'a Stretch, hypothesis: &'a Hypothesis) -> Self {
        Self::beside(stretch, hypothesis, None)
    }

    /// The same where it differs from another model in its springs alone.
    pub fn beside(
        stretch: &'a Stretch,
        hypothesis: &'a Hypothesis,
        same: Option<Same<'a>>,
    ) -> Self {
        let effects = built(&hypothesis.effects);
        let mut robot = hypothesis.robot;
        effects.iter().for_each(|effect| effect.change_robot(&mut robot));
        let springs: Vec<_> = effects.iter().filter_map(|effect| effect.transmission()).collect();
        let links = springs
            .iter()
            .fold(robot, |links, (joint, spring)| spring.without_motor(*joint, &links));
        Self {
            stretch,
            hypothesis,
            same,
            robot,
            links,
            springs,
            motor: reading::corrected(&stretch.motion, &effects),
            link: OnceCell::new(),
            postures: OnceCell::new(),
            drive_v: OnceCell::new(),
            needed_v: OnceCell::new(),
            feels_load: effects.iter().any(|effect| effect.feels_load()),
        }
    }

    /// Motion of the links.
    fn link(&self) -> &Kinematics {
        if self.springs.is_empty() {
            return &self.motor;
        }
        self.link.get_or_init(|| {
            let mut link = self.motor.as_ref().clone();
            for (joint, spring) in &self.springs {
                link.take_joint(*joint, self.behind(*joint, spring));
            }
            link
        })
    }

    /// Sines and cosines of the links' angles.
    fn postures(&self) -> &[Posture<f64>] {
        match self.moves_as_measured() {
            true => &self.stretch.postures,
            false => self.postures.get_or_init(|| self.link().postures()),
        }
    }

    /// Whether the links move as the encoders tell.
    pub fn moves_as_measured(&self) -> bool {
        self.springs.is_empty() && matches!(self.motor, Cow::Borrowed(_))
    }

    /// Motion of a joint's link behind a spring.
    fn behind(&self, joint: usize, spring: &Transmission) -> JointMotion {
        let felt = match self.same {
            Some(same) => Cow::Borrowed(same.felt[joint]),
            None => Cow::Owned(self.felt(joint)),
        };
        let push_nm = (spring.gap_rad > 0.0).then(|| match self.same {
            Some(same) => self.push_nm(joint, same.net_v[joint]),
            None => self.push_nm(joint, &self.net(joint)),
        });
        let period_s = self.stretch.period_s;
        link_motion::behind(spring, joint, &self.motor, &felt, push_nm.as_deref(), period_s)
    }

    /// Torque that pushes a joint in the interval after each sample [Nm].
    fn push_nm(&self, joint: usize, net_v: &[f64]) -> Vec<f64> {
        net_v.iter().map(|net_v| self.robot.torque_constant_nm_per_v[joint] * net_v).collect()
    }

    /// What each joint of the rig feels of the rest of the arm.
    pub fn felt(&self, joint: usize) -> Vec<Felt> {
        Felt::along(joint, &self.motor, &self.robot)
    }

    /// The robot with what effects change in it.
    pub fn robot(&self) -> &Robot<f64> {
        &self.robot
    }

    /// What the motor of a joint (0 to 2) gave less what was needed, at the samples [V].
    pub fn residual(&self, joint: usize) -> Vec<f64> {
        self.left(joint, &self.net(joint))
    }

    /// The same, by what drives the joint less friction [V].
    pub fn left(&self, joint: usize, net_v: &[f64]) -> Vec<f64> {
        let given = at_samples(net_v);
        let needed = self.needed(joint);
        let lag_s = self.hypothesis.lag_s[joint];
        let slope = self.command_slope(joint);
        (0..given.len()).map(|k| given[k] - needed[k] - lag_s * slope[k]).collect()
    }

    /// Change of the command per second, at the samples [V/s].
    pub fn command_slope(&self, joint: usize) -> Vec<f64> {
        derivative::first(&at_samples(&self.stretch.command_v[joint]), self.stretch.period_s)
    }

    /// Voltage that the rigid body needs at the samples, eq. (5).
    pub fn needed(&self, joint: usize) -> &[f64] {
        &self.needed_v.get_or_init(|| self.needed_by_all())[joint]
    }

    fn needed_by_all(&self) -> [Vec<f64>; 3] {
        let k_t = &self.robot.torque_constant_nm_per_v;
        let mut needed_v = [0, 1, 2].map(|_| Vec::with_capacity(self.stretch.len()));
        let (link, postures) = (self.link(), self.postures());
        for (k, posture) in postures.iter().enumerate() {
            let (_, qd, qdd) = link.state(k);
            let mut torque_nm =
                posture.inverse_dynamics(&self.links.base, &self.links.geometry, &qd, &qdd);
            for (joint, spring) in &self.springs {
                let qdd = self.motor.qdd_rad_per_s2[*joint][k];
                torque_nm[*joint] += spring.motor_inertia_kg_m2 * qdd;
            }
            (0..3).for_each(|joint| needed_v[joint].push(torque_nm[joint] / k_t[joint]));
        }
        needed_v
    }

    /// A row of the regressor at the samples, in volts per unit of the base parameter.
    pub fn regressor_row(&self, joint: usize) -> Vec<[f64; model::base::COUNT]> {
        let k_t = self.robot.torque_constant_nm_per_v[joint];
        let (link, postures) = (self.link(), self.postures());
        let at = |k: usize| {
            let (_, qd, qdd) = link.state(k);
            let geometry = &self.links.geometry;
            model::regressor::regressor(&postures[k], geometry, &qd, &qdd)[joint].map(|r| r / k_t)
        };
        (0..self.stretch.len()).map(at).collect()
    }

    /// Voltage left for the rigid body in the interval after each sample: what drives the
    /// joint less friction [V].
    pub fn net(&self, joint: usize) -> Vec<f64> {
        let mut net = self.drive(joint);
        let friction = self.friction(joint, &self.robot);
        net.iter_mut().zip(&friction).for_each(|(drive, friction)| *drive -= friction);
        net
    }

    /// The command as the motor feels it in the interval after each sample, with the
    /// voltages and torques that effects add [V].
    pub fn drive(&self, joint: usize) -> Vec<f64> {
        match self.hypothesis.effects.is_empty() {
            true => self.stretch.command_v[joint].clone(),
            false => self.drive_v.get_or_init(|| self.driven_by_effects())[joint].clone(),
        }
    }

    fn driven_by_effects(&self) -> [Vec<f64>; 3] {
        let mut effects = built(&self.hypothesis.effects);
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

    /// Friction of a robot's joint in the interval after each sample [V].
    pub fn friction(&self, joint: usize, robot: &Robot<f64>) -> Vec<f64> {
        let effects = built(&self.hypothesis.effects);
        let friction = &robot.friction[joint];
        let half_s = 0.5 * self.stretch.period_s;
        let v = &self.motor.qd_rad_per_s[joint];
        let last = v.len() - 1;
        let mut bend = FrictionState::default();
        let mut interval = |k: usize| {
            let mut scale = [FrictionScale::unchanged(); 3];
            if !effects.is_empty() {
                let joint_state = self.joint_state(k);
                effects.iter().for_each(|e| e.change_friction(&joint_state, &mut scale));
            }
            let (here, next) = (v[k], v[(k + 1).min(last)]);
            let (early, late) = (0.75 * here + 0.25 * next, 0.25 * here + 0.75 * next);
            0.5 * (bend.step_scaled(friction, scale[joint], early, half_s)
                + bend.step_scaled(friction, scale[joint], late, half_s))
        };
        (0..v.len()).map(&mut interval).collect()
    }

    /// How the bristles of each joint are bent at every sample.
    pub fn bends(&self) -> Vec<[FrictionState<f64>; 3]> {
        let effects = built(&self.hypothesis.effects);
        let mut bends = [FrictionState::default(); 3];
        let mut at = |k: usize| {
            let before = bends;
            let mut scale = [FrictionScale::unchanged(); 3];
            if !effects.is_empty() {
                let joint_state = self.joint_state(k);
                effects.iter().for_each(|e| e.change_friction(&joint_state, &mut scale));
            }
            for (joint, bend) in bends.iter_mut().enumerate() {
                let v = self.motor.qd_rad_per_s[joint][k];
                let friction = &self.robot.friction[joint];
                bend.step_scaled(friction, scale[joint], v, self.stretch.period_s);
            }
            before
        };
        (0..self.stretch.len()).map(&mut at).collect()
    }

    /// Angles, velocities and accelerations of the motors at a sample.
    pub fn motor_state(&self, k: usize) -> ([f64; 3], [f64; 3], [f64; 3]) {
        self.motor.state(k)
    }

    /// The middle of an interval, as effects see it.
    fn joint_state(&self, k: usize) -> JointState {
        let next = (k + 1).min(self.stretch.len() - 1);
        let middle =
            |signal: &[Vec<f64>; 3]| [0, 1, 2].map(|i| 0.5 * (signal[i][k] + signal[i][next]));
        let q_rad = middle(&self.motor.q_rad);
        let qd_rad_per_s = middle(&self.motor.qd_rad_per_s);
        let load_nm = match self.feels_load {
            true => load(&self.robot, &q_rad, &qd_rad_per_s),
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
            load(&self.robot, &q, &qd)[joint]
        };
        (0..self.stretch.len()).map(at).collect()
    }
}

fn load(robot: &Robot<f64>, q_rad: &[f64; 3], qd_rad_per_s: &[f64; 3]) -> [f64; 3] {
    let posture = Posture::new(q_rad[1], q_rad[2]);
    let coriolis = posture.coriolis(&robot.base, &robot.geometry, qd_rad_per_s);
    let gravity = posture.gravity(&robot.base, &robot.geometry);
    [0, 1, 2].map(|i| coriolis[i] + gravity[i])
}

fn built(effects: &[EffectInstance]) -> Vec<Box<dyn Effect>> {
    effects.iter().filter_map(EffectInstance::build).collect()
}

/// What acts over the two intervals about each sample, on average.
pub fn at_samples(intervals: &[f64]) -> Vec<f64> {
    let at = |k: usize| 0.5 * (intervals[k.saturating_sub(1)] + intervals[k]);
    (0..intervals.len()).map(at).collect()
}
