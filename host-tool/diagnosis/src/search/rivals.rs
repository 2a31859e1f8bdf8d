//! What else explains what an effect explains: other finalists in its place, and the same effect on other
//! joints.

use rayon::prelude::*;

use super::found::{Added, Rival};
use super::harmonics;
use super::policy::{explains_as, gain, is_more_than, is_physical};
use super::selection::Search;
use crate::fit::fitted_model::FittedModel;
use crate::trial::hypothesis::{EffectInstance, LATE};
use rig::effects::{Carrier, Definition, Kind, Search as From, Touches};

impl Search<'_> {
    /// What each effect gains, and what its rivals would in its place; a rival that does better
    /// takes it.
    pub(super) fn compared(&mut self) -> Vec<Added> {
        let known = self.subject.known_effects.len();
        let mut added = Vec::new();
        for index in 0..self.rivals.len() {
            let without = self.without(known + index).unwrap_or_else(|| self.last.clone());
            let mut rivals = self.rivals_of(index, &without);
            if rivals.first().is_some_and(|rival| rival.gain > 0.0) {
                let better = rivals[0].model.clone();
                let loser = self.last.linear.hypothesis.effects[known + index].clone();
                let model = std::mem::replace(&mut self.last, better);
                rivals[0] = Rival { effect: loser, gain: 0.0, model, objection: None };
                for rival in &mut rivals {
                    rival.gain = self.advantage(&rival.model, known + index);
                }
                rivals = each_once(rivals);
            }
            let effect = &self.last.linear.hypothesis.effects[known + index];
            rivals.retain(|rival| !rival.effect.is_same_cause(effect));
            added.push(Added { gain: gain(&without, &self.last), without, rivals });
        }
        added
    }

    /// By how much a model with another effect at this place is likelier than the last one, beforehand and
    /// by the logs (a logarithm).
    fn advantage(&self, model: &FittedModel, place: usize) -> f64 {
        let orders = self.subject.criteria.selection.likely_orders;
        let beforehand = |model: &FittedModel| -> f64 {
            match model.linear.hypothesis.effects[place].is_wave() {
                true => -orders.ln(),
                false => 0.0,
            }
        };
        self.gain_in_place(model, place) + beforehand(model) - beforehand(&self.last)
    }

    /// By how much it is so by the logs. A lag and a delay differ by little, on their joint alone.
    fn gain_in_place(&self, model: &FittedModel, place: usize) -> f64 {
        let [now, other] = [&self.last, model].map(|model| &model.linear.hypothesis.effects[place]);
        match now.late_joint() {
            Some(joint) if other.late_joint() == Some(joint) => model.gain_on(&self.last, joint),
            _ => gain(&self.last, model),
        }
    }

    /// Finalists of a round in the place of the effect that was added, and the same effect on other joints,
    /// the best first: those that explain what it explains, and not something on another joint.
    fn rivals_of(&self, index: usize, without: &FittedModel) -> Vec<Rival> {
        let place = self.subject.known_effects.len() + index;
        let effect = &self.last.linear.hypothesis.effects[place];
        let policy = &self.subject.criteria.selection;
        let finalists = self.rivals[index].iter().take(policy.rivals);
        let mut tried: Vec<EffectInstance> = self.on_other_joints(effect);
        tried.extend(self.beside_gravity(effect, without));
        tried.extend(self.late_otherwise(effect));
        tried.extend(finalists.cloned());
        let mut rivals: Vec<Rival> =
            tried.into_par_iter().filter_map(|rival| self.in_place(place, rival)).collect();
        let least = policy.least_log_likelihood;
        rivals.retain(|rival| !is_more_than(&rival.effect, effect) || rival.gain > least);
        rivals.retain(|rival| explains_as(effect.joint, without, &self.last, &rival.model));
        each_once(rivals)
    }

    /// An effect in the place of the one that was added.
    fn in_place(&self, place: usize, effect: EffectInstance) -> Option<Rival> {
        let (is_far, is_late) = (scales_command(&effect), effect.is_late());
        let start = self.last.linear.hypothesis.with_instead(place, effect);
        let mut model = self.fitted(start.clone())?;
        if is_far || is_late {
            let steps = self.subject.criteria.selection.accepted_steps;
            // By its own slopes: on from where the last one's led, and where they may have led astray from the start.
            for start in [model.linear.hypothesis.clone(), start] {
                let anew = FittedModel::fitted(&model.evidence, self.subject, start, steps);
                model = anew.into_iter().fold(model, FittedModel::better_of);
            }
        }
        if is_late {
            // A lag and a delay differ by little: by less than a fit that has not come to its end leaves on other joints.
            model = model.settled(self.subject);
        }
        let effect = model.linear.hypothesis.effects[place].clone();
        let gain = self.advantage(&model, place);
        is_physical(&effect, self.subject, &model.evidence).then_some(Rival {
            effect,
            gain,
            model,
            objection: None,
        })
    }

    /// The effect that does nearly the same on each other joint: one motor's torque constant too large or
    /// all others' too small differ but by the parameters that either asks for.
    fn on_other_joints(&self, effect: &EffectInstance) -> Vec<EffectInstance> {
        if !scales_command(effect) {
            return Vec::new();
        }
        let others = &self.last.linear.hypothesis.effects;
        let is_new = |joint: &u8| {
            !others.iter().any(|o| o.joint == *joint && o.definition.name == effect.definition.name)
        };
        let joints = self.subject.joints.iter().map(|&joint| joint as u8 + 1);
        let values: Vec<f64> = effect.values.iter().map(|value| -value).collect();
        joints
            .filter(is_new)
            .map(|joint| EffectInstance { joint, values: values.clone(), ..effect.clone() })
            .collect()
    }

    /// A delay in the place of a lag, and the other way round: below the corner of a lag both make a command later by
    /// the same time.
    fn late_otherwise(&self, effect: &EffectInstance) -> Option<EffectInstance> {
        let is_other = |definition: &&'static Definition| {
            LATE.contains(&definition.name) && definition.name != effect.definition.name
        };
        let definition =
            effect.is_late().then(|| self.subject.catalogue.iter().find(is_other))??;
        let others = &self.last.linear.hypothesis.effects;
        let rival = EffectInstance { definition, ..effect.clone() };
        let is_new = !others.iter().any(|other| other.has_place_of(&rival));
        is_new.then_some(rival)
    }

    /// Where a wave is one of the voltage, those of the command one order up and down, and the other way round: a
    /// command that holds an arm against gravity goes once per turn itself, and the product of two waves are two.
    fn beside_gravity(&self, wave: &EffectInstance, without: &FittedModel) -> Vec<EffectInstance> {
        let other = match wave.definition.search {
            From::Harmonics(Carrier::Unity) => Carrier::Command,
            From::Harmonics(Carrier::Command) => Carrier::Unity,
            _ => return Vec::new(),
        };
        let multiplies = |search: From| matches!(search, From::Harmonics(by) if by == other);
        let is_other = |definition: &&'static Definition| multiplies(definition.search);
        let Some(definition) = self.subject.catalogue.iter().find(is_other) else {
            return Vec::new();
        };
        let (order, joint) = (wave.order().unwrap_or_default(), usize::from(wave.joint) - 1);
        let at = |order: f64| {
            let FittedModel { linear, evidence, .. } = without;
            let harmonic = harmonics::of_order(linear, evidence, joint, other, order)?;
            Some(EffectInstance { definition, joint: wave.joint, values: harmonic.values() })
        };
        // Gravity goes once per turn of the joint, orders are the motor's.
        let turn = 1.0 / self.subject.plant.gears[joint].motor.abs();
        let others = &self.last.linear.hypothesis.effects;
        let is_new = |rival: &EffectInstance| !others.iter().any(|o| o.is_same_cause(rival));
        let beside = [order - turn, order + turn].into_iter().filter(|order| *order >= 1.0);
        beside.filter_map(at).filter(is_new).collect()
    }
}

/// The best first, and each cause once, from whatever starts it was found.
fn each_once(mut rivals: Vec<Rival>) -> Vec<Rival> {
    rivals.sort_by(|a, b| b.gain.total_cmp(&a.gain));
    let mut kept: Vec<Rival> = Vec::new();
    for rival in rivals {
        if !kept.iter().any(|other| other.effect.is_same_cause(&rival.effect)) {
            kept.push(rival);
        }
    }
    kept
}

/// Whether an effect is a factor of its joint's command alone, for which parameters stand in.
fn scales_command(effect: &EffectInstance) -> bool {
    let definition = effect.definition;
    definition.touches == Touches::DRIVE
        && definition.parameters.iter().all(|parameter| parameter.kind == Kind::RelativeChange)
}
