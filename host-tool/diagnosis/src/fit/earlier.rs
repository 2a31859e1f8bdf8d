//! Slopes that a model near by has already: most of them are the same in every model that is tried.

use nalgebra::DMatrixView;

use super::joint_slopes::JointSlopes;
use super::unknowns::{Expected, Unknown};
use crate::trial::hypothesis::{EffectInstance, Hypothesis};

/// Slopes of a model near by, and which of them are those of another.
#[derive(Default)]
pub struct Earlier<'a> {
    /// Slopes of the model near by.
    joints: &'a [JointSlopes],
    /// Place there of each place of the other model.
    places: Vec<Option<usize>>,
    /// Motor gain there in parts of that of the other model, by joint: slopes are in volts of the command as
    /// it was sent.
    gains: Vec<f64>,
}

impl<'a> Earlier<'a> {
    /// What of a model's slopes holds in another, which differs in a few effects or tables; nothing
    /// where links move otherwise, behind other springs.
    pub fn of(
        joints: &'a [JointSlopes],
        near: (&Hypothesis, &[Expected]),
        other: (&Hypothesis, &[Expected]),
    ) -> Self {
        let springs = |hypothesis: &Hypothesis| -> Vec<EffectInstance> {
            hypothesis.effects.iter().filter(|effect| effect.is_spring()).cloned().collect()
        };
        if springs(near.0) != springs(other.0) {
            return Self::default();
        }
        let gain = |joint: usize| near.0.motor_gain(joint) / other.0.motor_gain(joint);
        let gains: Vec<f64> = (0..near.0.plant.joints()).map(gain).collect();
        let scales = |unknown: Unknown| match shaped_joint(unknown, other.0) {
            Some(joint) => gains[joint] == 1.0,
            None => true,
        };
        let same = |expected: &Expected| {
            scales(expected.unknown).then(|| same(expected.unknown, other.0, near.0))?
        };
        let place_of = |unknown: Unknown| near.1.iter().position(|e| e.unknown == unknown);
        let places = other.1.iter().map(|expected| place_of(same(expected)?)).collect();
        Self { joints, places, gains }
    }

    /// Whether a place has its slopes here.
    pub fn has(&self, place: usize) -> bool {
        self.places.get(place).is_some_and(Option::is_some)
    }

    /// By what a joint's columns are to be multiplied.
    pub fn gain(&self, joint: usize) -> f64 {
        self.gains.get(joint).copied().unwrap_or(1.0)
    }

    /// A joint's columns, with their places in the other model.
    pub fn of_joint(&self, joint: usize) -> Option<Vec<(usize, DMatrixView<'a, f64>)>> {
        let slopes = self.joints.iter().find(|slopes| slopes.joint == joint)?;
        let column = |(place, near): (usize, &Option<usize>)| {
            let column = slopes.places.iter().position(|of| Some(*of) == *near)?;
            Some((place, slopes.matrix.columns(column, 1)))
        };
        Some(self.places.iter().enumerate().filter_map(column).collect())
    }
}

/// The joint (from 0) of whose command a lag or an effect may shape a part: what that changes, in volts as
/// sent, is not what the motor makes of them.
fn shaped_joint(unknown: Unknown, hypothesis: &Hypothesis) -> Option<usize> {
    match unknown {
        Unknown::Lag(joint) => Some(joint),
        Unknown::Effect { index, .. } => {
            usize::from(hypothesis.effects[index].joint).checked_sub(1)
        }
        _ => None,
    }
}

/// What is open in one model, as it is numbered in another.
fn same(unknown: Unknown, from: &Hypothesis, to: &Hypothesis) -> Option<Unknown> {
    match unknown {
        Unknown::Effect { index, value } => {
            let place = to.effects.iter().position(|effect| *effect == from.effects[index])?;
            Some(Unknown::Effect { index: place, value })
        }
        Unknown::Table { index, knot } => {
            let table = &from.tables[index];
            let is_it = |other: &rig::effects::Table| {
                (other.joint, other.axis, &other.knots) == (table.joint, table.axis, &table.knots)
            };
            Some(Unknown::Table { index: to.tables.iter().position(is_it)?, knot })
        }
        unknown => Some(unknown),
    }
}
