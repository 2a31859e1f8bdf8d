//! A model with effects, as it is tried on the logs.

use std::f64::consts::{PI, TAU};

use model::chain::MAX_JOINTS;

use super::warmth::{USUAL_S, Warmth, Warmths};
use rig::Plant;
use rig::effects::{Catalogue, Definition, Effect, Kind, Table, Touches};
use rig::plant::Gear;

/// No gear takes less of its motor's torque.
const LEAST_GEAR_LOSS: f64 = 1e-3;

/// The choice of an effect `load_friction` that grows by the motor's torque.
const BY_MOTOR_TORQUE: f64 = 1.0;

/// Effects that make a command late, by one time each.
pub const LATE: [&str; 2] = ["actuator_lag", "delay"];

/// Effects that a refit of masses, inertias and friction nearly makes up for.
const LIKE_PARAMETERS: [&str; 2] = ["payload", TORQUE_CONSTANT];

/// The effect by which a motor gives more or less torque per volt than the model tells.
const TORQUE_CONSTANT: &str = "torque_constant";

/// The effect that resists by the square of speed.
const DRAG: &str = "quadratic_drag";

/// Orders closer than this are of one wave: its order need not be whole.
const SAME_ORDER: f64 = 0.5;

/// An effect with its parameters, on a joint.
#[derive(Clone, Debug)]
pub struct EffectInstance {
    /// What it is.
    pub definition: &'static Definition,
    /// Joint, from 1; 0 for the whole robot.
    pub joint: u8,
    /// Its parameters, in the order of the definition.
    pub values: Vec<f64>,
}

impl PartialEq for EffectInstance {
    fn eq(&self, other: &Self) -> bool {
        (self.definition.name, self.joint, &self.values)
            == (other.definition.name, other.joint, &other.values)
    }
}

impl EffectInstance {
    /// An effect as a subject tells it: what it is, its joint, its parameters.
    pub fn told((definition, joint, values): &(&'static Definition, u8, Vec<f64>)) -> Self {
        Self { definition, joint: *joint, values: values.clone() }
    }

    /// The effect, its values kept within their bounds; `None` if it acts on no such joint.
    pub fn build(&self) -> Option<Box<dyn Effect>> {
        self.definition.on_one_of(MAX_JOINTS as u8, self.joint, &self.bounded()).ok()
    }

    /// Whether another is the same effect on the same joint, whatever its values.
    pub fn has_place_of(&self, other: &Self) -> bool {
        (self.definition.name, self.joint) == (other.definition.name, other.joint)
    }

    /// Whether another is the same effect with other values: on the same joint, at the same harmonic.
    pub fn is_same_cause(&self, other: &Self) -> bool {
        let parameters = self.definition.parameters.iter().enumerate();
        let mut harmonics = parameters.filter(|(_, p)| p.kind == Kind::Harmonic).map(|(at, _)| at);
        let is_near = |at: usize| (self.values[at] - other.values[at]).abs() < SAME_ORDER;
        self.has_place_of(other) && harmonics.all(is_near)
    }

    /// The same cause as it is among others, with their values; itself where it is not.
    pub fn as_in<'a>(&'a self, others: &'a [Self]) -> &'a Self {
        others.iter().find(|other| other.is_same_cause(self)).unwrap_or(self)
    }

    /// Whether it is what a gear takes of its motor's torque: friction by the load on the joint may be beside it.
    pub fn is_of_gear(&self) -> bool {
        let mut parameters = self.definition.parameters.iter().zip(&self.values);
        self.definition.name == "load_friction"
            && parameters.any(|(p, value)| p.kind == Kind::Choice && *value == BY_MOTOR_TORQUE)
    }

    /// Whether it changes friction, or resists by speed: friction of another law than the model's may look like it.
    pub fn resembles_friction(&self) -> bool {
        self.definition.touches.friction || self.definition.name == DRAG
    }

    /// Whether parameters that a refit leaves open may look like it.
    pub fn resembles_parameters(&self) -> bool {
        LIKE_PARAMETERS.contains(&self.definition.name)
    }

    /// Whether it is a motor's torque per volt, off by a part.
    pub fn is_torque_constant(&self) -> bool {
        self.definition.name == TORQUE_CONSTANT
    }

    /// Whether it makes the command of its joint late.
    pub fn is_late(&self) -> bool {
        LATE.contains(&self.definition.name)
    }

    /// Whether another says the same by another name: that a joint's command comes late, by a lag or by a delay.
    pub fn says_the_same_as(&self, other: &Self) -> bool {
        self.is_late() && other.is_late() && self.joint == other.joint
    }

    /// The joint (from 0) whose command it makes late.
    pub fn late_joint(&self) -> Option<usize> {
        usize::from(self.joint).checked_sub(1).filter(|_| self.is_late())
    }

    /// Whether it is a wave of one order of many.
    pub fn is_wave(&self) -> bool {
        self.definition.parameters.iter().any(|parameter| parameter.kind == Kind::Harmonic)
    }

    /// The order of a wave, per turn.
    pub fn order(&self) -> Option<f64> {
        let mut parameters = self.definition.parameters.iter().zip(&self.values);
        parameters.find(|(p, _)| p.kind == Kind::Harmonic).map(|(_, order)| *order)
    }

    /// Whether both are waves of one order on one joint, per turn of that: the motor's turns are so many of the joint's.
    pub fn is_of_order_of(&self, other: &Self, gears: &[Gear]) -> bool {
        let order = |effect: &Self| {
            let gear = gears.get(usize::from(effect.joint).checked_sub(1)?)?;
            let turns = if effect.definition.touches.drive { gear.motor.abs() } else { 1.0 };
            Some(turns * effect.order()?)
        };
        let orders = order(self).zip(order(other));
        self.joint == other.joint && orders.is_some_and(|(own, of)| (own - of).abs() < SAME_ORDER)
    }

    /// Whether it leaves a gap between a motor and its link.
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

    /// Whether its size, its first value, is this close to a bound, in parts of that.
    pub fn is_at_bound(&self, near: f64) -> bool {
        let parameter = &self.definition.parameters[0];
        let at = |bound: f64| (self.values[0] - bound).abs() < near * bound.abs();
        at(parameter.lowest) || at(parameter.highest)
    }

    /// The values within their bounds.
    pub fn bounded(&self) -> Vec<f64> {
        let bounds = self.definition.parameters.iter();
        bounds.zip(&self.values).map(|(p, v)| v.clamp(p.lowest, p.highest)).collect()
    }
}

/// A model with effects: one explanation of the logs.
#[derive(Clone, Debug)]
pub struct Hypothesis {
    /// Rigid body and friction.
    pub plant: Plant,
    /// By how much each command comes later than the log says [s].
    pub lag_s: Vec<f64>,
    /// By how much each joint's dry friction runs ahead of its velocity: memory where it is negative;
    /// soft constraints of simulators lead [s].
    pub friction_lead_s: Vec<f64>,
    /// Part of every motor's torque by which the friction of its joint grows: what gears take.
    pub gear_loss: f64,
    /// What friction has more of in single logs; empty where it is the same in all.
    pub warmths: Warmths,
    /// Effects, in order.
    pub effects: Vec<EffectInstance>,
    /// Curves that act after the effects; no causes.
    pub tables: Vec<Table>,
}

impl Hypothesis {
    /// A model alone.
    pub fn bare(plant: Plant) -> Self {
        let none = vec![0.0; plant.joints()];
        let (effects, tables, warmths) = Default::default();
        let (lag_s, friction_lead_s) = (none.clone(), none);
        Self { plant, lag_s, friction_lead_s, gear_loss: 0.0, warmths, effects, tables }
    }

    /// The warmth of a joint (from 0) in a log; none where friction is the model's there.
    pub fn warmth(&self, joint: usize, log: usize) -> Option<Warmth> {
        self.warmths.get(&(joint, log)).copied()
    }

    /// The same with friction as it is so long after a log began [s], in all logs.
    pub fn as_warm_as_in(&self, log: usize, time_s: f64) -> Self {
        self.with_friction_times(|joint| self.warmth(joint, log).unwrap_or_default().factor(time_s))
    }

    /// The same with the mean friction of its logs, ten seconds after each began, in all.
    pub fn as_warm_as_usual(&self) -> Self {
        self.with_friction_times(|joint| {
            let of_joint = self.warmths.iter().filter(|((of, _), _)| *of == joint);
            let factors: Vec<f64> = of_joint.map(|(_, warmth)| warmth.factor(USUAL_S)).collect();
            let sum: f64 = factors.iter().sum();
            if factors.is_empty() { 1.0 } else { sum / factors.len() as f64 }
        })
    }

    /// The same with Coulomb and viscous friction of each joint (from 0) times a factor, in all logs.
    fn with_friction_times(&self, factor: impl Fn(usize) -> f64) -> Self {
        let mut same = Self { warmths: Warmths::new(), ..self.clone() };
        for (joint, friction) in same.plant.friction.iter_mut().enumerate() {
            let factor = factor(joint);
            friction.alpha0_v *= factor;
            friction.alpha1_v *= factor;
            friction.alpha2_v_s_per_rad *= factor;
        }
        same
    }

    /// Effects that stand for what gears take, in simulators and in model files; none where they take next to nothing.
    pub fn effects_of_gears(&self) -> Vec<EffectInstance> {
        if self.gear_loss < LEAST_GEAR_LOSS {
            return Vec::new();
        }
        let constants = &self.plant.torque_constant_nm_per_v;
        let Some(definition) = Catalogue::of_arm(constants.len()).by_name("load_friction") else {
            return Vec::new();
        };
        let of_joint = |(index, k_t): (usize, &f64)| EffectInstance {
            definition,
            joint: index as u8 + 1,
            values: vec![self.gear_loss / k_t, BY_MOTOR_TORQUE],
        };
        constants.iter().enumerate().map(of_joint).collect()
    }

    /// Its effects and then its tables, ready to act.
    pub fn built_effects(&self) -> Vec<Box<dyn Effect>> {
        let tables = self.tables.iter().map(|table| Box::new(table.clone()) as Box<dyn Effect>);
        let effects = self.effects.iter().filter_map(EffectInstance::build);
        let gears: Vec<_> =
            self.effects_of_gears().iter().filter_map(EffectInstance::build).collect();
        self.geared(effects.chain(gears).chain(tables).collect())
    }

    /// Those that change the friction of a joint (from 0), ready to act.
    pub fn effects_on_friction_of(&self, joint: usize) -> Vec<Box<dyn Effect>> {
        let of = |joint| self.effects_on(joint, |touches| touches.friction);
        self.geared(of(0).chain(of(joint as u8 + 1)).collect())
    }

    /// Those on a joint (from 0) that change what drives it, and then its tables, ready to act.
    pub fn effects_on_drive_of(&self, joint: usize) -> Vec<Box<dyn Effect>> {
        let of_joint = |table: &&Table| usize::from(table.joint) == joint + 1;
        let tables = self.tables.iter().filter(of_joint);
        let tables = tables.map(|table| Box::new(table.clone()) as Box<dyn Effect>);
        let own = self.effects_on(joint as u8 + 1, |touches| touches.drive);
        self.geared(own.chain(tables).collect())
    }

    /// Those on the whole robot that add torques to its joints, ready to act.
    pub fn effects_from_outside(&self) -> Vec<Box<dyn Effect>> {
        self.geared(self.effects_on(0, |touches| touches.drive).collect())
    }

    /// Those on a joint (from 1; 0: the whole robot) that touch what is wanted.
    fn effects_on(
        &self,
        joint: u8,
        wanted: fn(Touches) -> bool,
    ) -> impl Iterator<Item = Box<dyn Effect>> + '_ {
        let acts = move |effect: &&EffectInstance| {
            wanted(effect.definition.touches) && effect.joint == joint
        };
        self.effects.iter().filter(acts).filter_map(EffectInstance::build)
    }

    fn geared(&self, mut effects: Vec<Box<dyn Effect>>) -> Vec<Box<dyn Effect>> {
        effects.iter_mut().for_each(|effect| effect.set_gears(&self.plant.gears));
        effects
    }

    /// Torque that the motor of a joint (from 0) gives of every command, in parts of what its constant says.
    pub fn motor_gain(&self, joint: usize) -> f64 {
        let effects = self.effects.iter().filter_map(EffectInstance::build);
        effects.map(|effect| effect.motor_gain(joint)).product()
    }

    /// Whether it is a model alone, without effects and tables.
    pub fn is_bare(&self) -> bool {
        self.effects.is_empty() && self.tables.is_empty()
    }

    /// The same with one more effect, all else as it is.
    pub fn beside(&self, effect: EffectInstance) -> Self {
        let mut hypothesis = self.clone();
        hypothesis.effects.push(effect);
        hypothesis
    }

    /// The same with one more effect, what stood in for it given back.
    pub fn with(&self, effect: EffectInstance) -> Self {
        let late = effect.late_joint();
        self.beside(effect).with_lag_of_others(late)
    }

    /// The same with another effect in the place of one, what stood in for it given back.
    pub fn with_instead(&self, place: usize, effect: EffectInstance) -> Self {
        let mut hypothesis = self.clone();
        let late = effect.late_joint();
        hypothesis.effects[place] = effect;
        hypothesis.with_lag_of_others(late)
    }

    /// The same with what stands in for its effects from the place `first` on given back.
    pub fn with_room(self, first: usize) -> Self {
        let late: Vec<usize> = self.late_joints(first).collect();
        late.into_iter().fold(self, |hypothesis, joint| hypothesis.with_lag_of_others(Some(joint)))
    }

    /// The same with instants of a joint's commands as the log has them on other joints.
    fn with_lag_of_others(mut self, joint: Option<usize>) -> Self {
        if let Some(joint) = joint {
            self.lag_s[joint] = self.lag_of_others_s(joint);
        }
        self
    }

    /// Joints (from 0) whose commands an effect from the place `first` on makes late.
    pub fn late_joints(&self, first: usize) -> impl Iterator<Item = usize> + '_ {
        self.effects.iter().skip(first).filter_map(EffectInstance::late_joint)
    }

    /// The middle of the lags of the other joints that have one and that no effect makes late; where there are none, the
    /// joint's own if that is early, which is the log's [s].
    pub fn lag_of_others_s(&self, joint: usize) -> f64 {
        let tells = |&other: &usize| {
            other != joint && self.lag_s[other] != 0.0 && self.late_joints(0).all(|j| j != other)
        };
        let others = (0..self.lag_s.len()).filter(tells);
        let mut others: Vec<f64> = others.map(|other| self.lag_s[other]).collect();
        others.sort_by(f64::total_cmp);
        match others.len() {
            0 => self.lag_s[joint].min(0.0),
            count => 0.5 * (others[(count - 1) / 2] + others[count / 2]),
        }
    }

    /// Place of the spring, of those from `first` on, that one more effect takes the place of: a
    /// joint has one spring between motor and link.
    pub fn spring_replaced_by(&self, effect: &EffectInstance, first: usize) -> Option<usize> {
        let is_other = |other: &EffectInstance| other.is_spring() && other.joint == effect.joint;
        let mut others = self.effects.iter().skip(first);
        others.position(|other| effect.is_spring() && is_other(other)).map(|place| first + place)
    }
}
