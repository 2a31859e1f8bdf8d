//! How the rows of a linearised model change with one more effect, or with another value of one.

use super::linearisation::Linearisation;
use super::stretch_changes::{changed, changed_by_spring};
use crate::rows::evidence::{Evidence, RowChange};
use crate::trial::hypothesis::EffectInstance;

impl Linearisation {
    /// Change of train rows by one more effect.
    pub fn change_by(
        &self,
        evidence: &Evidence,
        effect: &EffectInstance,
        which: Joints,
    ) -> RowChange {
        let joints = changed_joints(evidence, effect, which);
        let others = &self.hypothesis.effects;
        let hypothesis = self.hypothesis.beside(effect.clone());
        let before = (&self.parts[..], &self.hypothesis);
        changed(evidence, before, &hypothesis, (effect, others), &joints)
    }

    /// The same to first order in how far a link is ahead of its motor, where the effect is the first spring of its
    /// joint: enough to tell where a search should begin.
    pub fn change_nearly_by(
        &self,
        evidence: &Evidence,
        effect: &EffectInstance,
        which: Joints,
    ) -> RowChange {
        let takes_a_place =
            |other: &EffectInstance| other.is_spring() && other.joint == effect.joint;
        // The closed form is as quick as its slopes.
        let is_quick = self.hypothesis.plant.as_chain().is_none();
        if !effect.is_spring() || is_quick || self.hypothesis.effects.iter().any(takes_a_place) {
            return self.change_by(evidence, effect, which);
        }
        let joints = changed_joints(evidence, effect, which);
        let hypothesis = self.hypothesis.beside(effect.clone());
        changed_by_spring(evidence, &self.parts, &hypothesis, effect, &joints)
    }
}

/// The joints (from 0) whose rows an effect changes, of those that are wanted.
fn changed_joints(evidence: &Evidence, effect: &EffectInstance, which: Joints) -> Vec<usize> {
    let own = usize::from(effect.joint).checked_sub(1);
    match own.filter(|_| !effect.definition.couples_joints || which == Joints::Own) {
        None => evidence.joints.clone(),
        Some(own) => vec![own],
    }
}

/// Which joints' rows of a change are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Joints {
    /// Those that it changes.
    All,
    /// The effect's own.
    Own,
}
