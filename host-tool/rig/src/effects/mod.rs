//! The catalogue of effects that the model does not hold, one file each.
//!
//! A file says what the effect is, in words and as an equation, which parameters it has
//! and what it does to the simulated robot. Adding one is adding a file and its line in
//! [`CATALOGUE`].
//!
//! u is the command, q the joint as its encoder sees it, n a harmonic per turn.

mod actuator_lag;
mod asymmetric_friction;
mod backlash;
mod base_tilt;
mod cable_spring;
mod cogging;
mod dac_offset;
mod dead_zone;
mod delay;
mod encoder_eccentricity;
mod friction_drift;
mod joint_elasticity;
mod load_friction;
mod parse;
mod payload;
mod position_friction;
mod quadratic_drag;
mod saturation;
mod search;
mod tip_force;
mod torque_constant;
mod torque_ripple;
mod transmission;

pub use parse::{EffectError, definition_and_values, effect_of, table_from_text};
pub use search::{Carrier, Search, Size, Touches, Typical};
pub use transmission::Transmission;

use std::fmt::Debug;

use model::Robot;
use model::friction::FrictionScale;
use model::vector::Vector3;

/// All effects, in the order of the contract.
pub const CATALOGUE: [&Definition; 20] = [
    &torque_constant::DEFINITION,
    &actuator_lag::DEFINITION,
    &delay::DEFINITION,
    &position_friction::DEFINITION,
    &cogging::DEFINITION,
    &torque_ripple::DEFINITION,
    &payload::DEFINITION,
    &tip_force::DEFINITION,
    &base_tilt::DEFINITION,
    &joint_elasticity::DEFINITION,
    &backlash::DEFINITION,
    &asymmetric_friction::DEFINITION,
    &load_friction::DEFINITION,
    &friction_drift::DEFINITION,
    &cable_spring::DEFINITION,
    &dac_offset::DEFINITION,
    &saturation::DEFINITION,
    &dead_zone::DEFINITION,
    &encoder_eccentricity::DEFINITION,
    &quadratic_drag::DEFINITION,
];

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
    /// The experiment that shows it best.
    pub experiment: &'static str,
    /// The effect with these values, one per parameter, on a joint (1 to 3, or 0).
    build: fn(joint: u8, values: &[f64]) -> Box<dyn Effect>,
}

/// A parameter of an effect.
#[derive(Debug)]
pub struct Parameter {
    /// Its name, with its unit; the components of a vector bear the same name.
    pub name: &'static str,
    /// The least that it can be.
    pub lowest: f64,
    /// The most that it can be.
    pub highest: f64,
    /// Whether it may be left out, and is zero then.
    pub optional: bool,
}

impl Parameter {
    /// A parameter with its bounds.
    pub const fn new(name: &'static str, lowest: f64, highest: f64) -> Self {
        Self { name, lowest, highest, optional: false }
    }

    /// A parameter that is zero where it is left out.
    pub const fn optional(name: &'static str, lowest: f64, highest: f64) -> Self {
        Self { name, lowest, highest, optional: true }
    }
}

/// The robot at one instant, as effects see it.
#[derive(Clone, Copy, Debug)]
pub struct JointState {
    /// Time since the log began [s].
    pub time_s: f64,
    /// Joints as their encoders see them [rad].
    pub q_rad: Vector3<f64>,
    /// Their velocities [rad/s].
    pub qd_rad_per_s: Vector3<f64>,
    /// Coriolis and gravity torques c + h [Nm].
    pub load_nm: Vector3<f64>,
}

/// What an effect does to the simulated robot; it does nothing unless it says so.
///
/// Several act one after the other in the order in which they are given.
pub trait Effect: Debug + Send {
    /// Changes the robot itself, before it moves.
    fn change_robot(&self, _robot: &mut Robot<f64>) {}

    /// The time between calls of [`Self::change_command`] [s], told once at the beginning.
    fn set_step(&mut self, _step_s: f64) {}

    /// Changes the voltages on their way from the converter to the motors.
    fn change_command(&mut self, _state: &JointState, _command_v: &mut Vector3<f64>) {}

    /// Whether it asks for the load at that instant.
    fn feels_load(&self) -> bool {
        false
    }

    /// Changes the level and the viscous part of friction.
    fn change_friction(&self, _state: &JointState, _scale: &mut [FrictionScale<f64>; 3]) {}

    /// Adds voltages to what the motors make of the command.
    fn add_voltage(&self, _state: &JointState, _voltage_v: &mut Vector3<f64>) {}

    /// Adds torques from outside [Nm].
    fn add_torque(&self, _state: &JointState, _robot: &Robot<f64>, _torque_nm: &mut Vector3<f64>) {}

    /// Changes the angles that the encoders read.
    fn change_reading(&self, _q_rad: &mut Vector3<f64>) {}

    /// What stands between motor and link, and at which joint (0 to 2).
    fn transmission(&self) -> Option<(usize, Transmission)> {
        None
    }
}

impl Definition {
    /// The effect of that name.
    pub fn by_name(name: &str) -> Option<&'static Self> {
        CATALOGUE.into_iter().find(|definition| definition.name == name)
    }

    /// The effect with these values, on a joint (1 to 3, or 0 for the whole robot).
    ///
    /// # Errors
    /// A joint that the effect cannot act on, too few or too many values, or one out of bounds.
    pub fn with(&self, joint: u8, values: &[f64]) -> Result<Box<dyn Effect>, EffectError> {
        self.check(joint, values)?;
        Ok((self.build)(joint, values))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_effect_has_another_name_and_finite_bounds() {
        for (index, definition) in CATALOGUE.iter().enumerate() {
            assert!(CATALOGUE[..index].iter().all(|other| other.name != definition.name));
            for parameter in definition.parameters {
                assert!(parameter.lowest < parameter.highest, "{}", definition.name);
            }
        }
    }
}
