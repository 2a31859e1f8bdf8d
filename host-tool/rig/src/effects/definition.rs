//! An effect as a kind: all that is known of it before its parameters are.

use super::compensation::Compensation;
use super::confusion::{Confused, Confusion};
use super::effect::Effect;
use super::error::EffectError;
use super::parameter::{Kind, Parameter};
use super::random::Random;
use super::search::{Search, Size};
use super::sizes::DrawContext;

/// Joints of the robot that the board drives.
pub(super) const BOARD_JOINTS: u8 = 3;

/// An effect as a kind, before its parameters are known.
#[derive(Debug)]
pub struct Definition {
    /// Its name in reports and model files.
    pub name: &'static str,
    /// What it is, in words.
    pub words: &'static str,
    /// What it is, as an equation.
    pub equation: &'static str,
    /// Whether it acts on the whole robot (joint 0) or on one joint.
    pub whole_robot: bool,
    /// Its parameters.
    pub parameters: &'static [Parameter],
    /// Whether it shows in the commands of other joints as well.
    pub couples_joints: bool,
    /// What it changes in the equation of the diagnosis.
    pub touches: Touches,
    /// Where a search for its parameters begins.
    pub search: Search,
    /// What its first parameter says of its size.
    pub size: Size,
    /// Values of its parameters, drawn for a blind trial.
    pub draw: fn(&DrawContext, &mut dyn Random) -> Vec<f64>,
    /// What it is confused with; each pair stands in one of its two effects.
    pub confused_with: &'static [Confusion],
    /// Whether and how the board compensates for it.
    pub compensation: Compensation,
    /// The experiment that shows it best.
    pub experiment: &'static str,
    /// The effect with these values, one per parameter, on a joint (from 1, or 0); called with
    /// a joint and values that fit.
    pub build: fn(joint: u8, values: &[f64]) -> Box<dyn Effect>,
}

/// What an effect changes in: command as the motor feels it = friction + rigid body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Touches {
    /// What drives the joint: the command, voltages and torques that are added.
    pub drive: bool,
    /// Friction.
    pub friction: bool,
    /// What the rigid body needs.
    pub body: bool,
}

impl Touches {
    /// The drive alone.
    pub const DRIVE: Self = Self { drive: true, friction: false, body: false };
    /// Friction alone.
    pub const FRICTION: Self = Self { drive: false, friction: true, body: false };
    /// The rigid body or the motion of its links.
    pub const BODY: Self = Self { drive: false, friction: false, body: true };
    /// The reading of the encoder, and so friction and the rigid body.
    pub const READING: Self = Self { drive: false, friction: true, body: true };
}

impl Definition {
    /// The effect with these values, on a joint (1 to 3, or 0 for the whole robot).
    ///
    /// # Errors
    /// A joint that the effect cannot act on, too few or too many values, or one out of bounds.
    pub fn with(&self, joint: u8, values: &[f64]) -> Result<Box<dyn Effect>, EffectError> {
        self.on_one_of(BOARD_JOINTS, joint, values)
    }

    /// The same on an arm of so many joints.
    ///
    /// # Errors
    /// Those of [`Self::with`].
    pub fn on_one_of(
        &self,
        joints: u8,
        joint: u8,
        values: &[f64],
    ) -> Result<Box<dyn Effect>, EffectError> {
        self.check(joints, joint, values)?;
        Ok((self.build)(joint, values))
    }

    fn check(&self, joints: u8, joint: u8, values: &[f64]) -> Result<(), EffectError> {
        let right = match (self.whole_robot, joints) {
            (true, _) => "the whole robot (joint 0)",
            (false, BOARD_JOINTS) => "joint 1, 2 or 3",
            (false, _) => "a joint of the arm",
        };
        if self.whole_robot != (joint == 0) || joint > joints {
            return Err(EffectError::Joint { effect: self.name, right, joint });
        }
        if values.len() != self.parameters.len() {
            return Err(self.wrong_parameters(format!("{} values", values.len())));
        }
        let mut both = self.parameters.iter().zip(values);
        both.try_for_each(|(parameter, &value)| self.check_value(parameter, value))
    }

    fn check_value(&self, known: &Parameter, value: f64) -> Result<(), EffectError> {
        let (effect, parameter) = (self.name, known.name);
        let &Parameter { kind, lowest, highest, .. } = known;
        match kind {
            Kind::Choice if ![lowest, highest].contains(&value) => {
                Err(EffectError::Choice { effect, parameter, value, lowest, highest })
            }
            _ if !(lowest..=highest).contains(&value) => {
                Err(EffectError::Value { effect, parameter, value, lowest, highest })
            }
            _ => Ok(()),
        }
    }

    /// The refusal of parameters that are not those of the effect.
    pub(super) fn wrong_parameters(&self, found: String) -> EffectError {
        let expected = self.parameter_names().join(", ");
        EffectError::Parameters { effect: self.name, expected, found }
    }

    /// The names of its parameters, each once.
    pub fn parameter_names(&self) -> Vec<&'static str> {
        let mut names: Vec<_> = self.parameters.iter().map(|parameter| parameter.name).collect();
        names.dedup();
        names
    }

    /// Whether it and another are one thing under two names.
    pub fn is_twin_of(&self, other: &Self) -> bool {
        let names = |a: &Self, b: &Self| {
            a.confused_with.iter().any(|c| c.never_paired && c.with == Confused::Effect(b.name))
        };
        names(self, other) || names(other, self)
    }
}
