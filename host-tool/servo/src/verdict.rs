//! Causes, from what was selected, on the logs that confirm.

use crate::base::{Base, Frame};
use crate::confirm::{Taken, Unit, probability, squares, units};
use crate::joint::ServoJoint;
use crate::joint_model::Model;
use crate::judged::Judged;
use crate::pooled::PooledLoad;
use crate::selection::Selected;

/// A cause on a joint and what it takes.
#[derive(Clone, Debug)]
pub struct JointCause {
    /// Its name.
    pub effect: &'static str,
    /// The joint, from 0.
    pub joint: usize,
    /// The joint with it.
    pub servo: ServoJoint,
    /// On the confirming logs.
    pub taken: Taken,
    /// That it is one, 0 to 1.
    pub probability: f64,
    /// Whether it may be named.
    pub is_named: bool,
}

/// Squares of a joint on the confirming logs.
pub struct Confirming<'a> {
    /// The logs.
    pub logs: &'a [&'a Judged],
    /// A row's square by the encoder alone, joint by joint [rad^2].
    pub noise: &'a [f64],
    /// Squares that a cause must take, joint by joint [rad^2].
    pub least: &'a [f64],
}

impl Confirming<'_> {
    fn units(&self, frame: &Frame, servo: &ServoJoint, joint: usize) -> Vec<Unit> {
        units(servo, joint, self.logs, frame.settings.search_step_s)
    }

    /// Whether enough goes of what is left without a cause.
    fn takes_enough(&self, joint: usize, without: &[Unit], with: &[Unit]) -> bool {
        squares(without) - squares(with) >= self.least[joint]
    }
}

/// The effects that were selected for a joint, each taken away once.
pub fn of_joint(
    frame: &Frame,
    confirming: &Confirming,
    joint: usize,
    base: &Base,
    selected: &Selected,
) -> Vec<JointCause> {
    let model = &selected.model;
    let with = confirming.units(frame, &model.fitted.servo, joint);
    let bare = confirming.units(frame, &selected.base.fitted.servo, joint);
    let of = |k: usize| {
        let others = model.without(frame, joint, base, k);
        let without = confirming.units(frame, &others.fitted.servo, joint);
        let taken = Taken::of(&bare, &without, &with, confirming.noise[joint], frame.settings);
        let certainty = taken.certainty.min(selected.added[k].certainty);
        JointCause {
            effect: model.effects[k].effect,
            joint,
            servo: model.fitted.servo,
            taken,
            probability: probability(certainty),
            is_named: taken.is_confirmed(&model.settings(frame.settings))
                && confirming.takes_enough(joint, &without, &with),
        }
    };
    (0..model.effects.len()).map(of).collect()
}

/// The model of a joint with the effects that are named alone.
pub fn named_model(
    frame: &Frame,
    joint: usize,
    base: &Base,
    selected: &Selected,
    causes: &[JointCause],
) -> Model {
    let mut model = selected.model.clone();
    for k in (0..causes.len()).rev().filter(|k| !causes[*k].is_named) {
        model = model.without(frame, joint, base, k);
    }
    model
}

/// Load friction in common of a group: its share on each joint, the one with most of it first.
pub fn of_pool(frame: &Frame, confirming: &Confirming, pooled: &PooledLoad) -> Vec<JointCause> {
    let (without, with) = (&pooled.without, &pooled.with);
    let mut found: Vec<JointCause> = (0..with.joints.len())
        .map(|k| {
            let joint = with.joints[k];
            let bare = confirming.units(frame, &without.servos[k], joint);
            let loaded = confirming.units(frame, &with.servos[k], joint);
            let taken = Taken::of(&bare, &bare, &loaded, confirming.noise[joint], frame.settings);
            JointCause {
                effect: "load_friction",
                joint,
                servo: with.servos[k],
                taken,
                probability: probability(taken.certainty.min(pooled.gain.certainty)),
                is_named: taken.is_confirmed(frame.settings)
                    && confirming.takes_enough(joint, &bare, &loaded),
            }
        })
        .collect();
    found.sort_by(|a, b| b.taken.share.total_cmp(&a.taken.share));
    found
}
