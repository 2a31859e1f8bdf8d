//! What an effect does to the simulated robot.

use std::fmt::Debug;

use model::friction::FrictionScale;

use super::transmission::Transmission;
use crate::plant::{Gear, Plant};

/// The robot at one instant, as effects see it.
#[derive(Clone, Copy, Debug)]
pub struct JointState<'a> {
    /// Time since the log began [s].
    pub time_s: f64,
    /// Joints as their encoders see them [rad].
    pub q_rad: &'a [f64],
    /// Their velocities [rad/s].
    pub qd_rad_per_s: &'a [f64],
    /// Coriolis and gravity torques c + h [Nm].
    pub load_nm: &'a [f64],
    /// Torques that the motors make of what they are sent [Nm].
    pub motor_nm: &'a [f64],
}

/// What an effect does to the simulated robot; it does nothing unless it says so.
///
/// Several act one after the other in the order in which they are given.
pub trait Effect: Debug + Send + Sync {
    /// Changes the robot itself, before it moves.
    fn change_robot(&self, _plant: &mut Plant) {}

    /// Takes the turns of every joint's shafts, once at the beginning; else each is its joint.
    fn set_gears(&mut self, _gears: &[Gear]) {}

    /// Takes the time between calls of [`Self::change_command`] [s], once at the beginning.
    fn set_step(&mut self, _step_s: f64) {}

    /// Takes the time between the samples of a recorded motion that it acts along [s], once at the beginning; else
    /// what it does is of one instant. What varies meanwhile acts as second differences of the motion feel it.
    fn set_interval(&mut self, _interval_s: f64) {}

    /// Changes the voltages on their way from the converter to the motors.
    fn change_command(&mut self, _state: &JointState, _command_v: &mut [f64]) {}

    /// Torque that the motor of a joint (from 0) gives of every command, in parts of what its torque constant
    /// says.
    fn motor_gain(&self, _joint: usize) -> f64 {
        1.0
    }

    /// Whether it needs [`JointState::load_nm`].
    fn feels_load(&self) -> bool {
        false
    }

    /// Whether it needs [`JointState::motor_nm`].
    fn feels_motor_torque(&self) -> bool {
        false
    }

    /// Changes the level and the viscous part of friction.
    fn change_friction(&self, _state: &JointState, _scale: &mut [FrictionScale<f64>]) {}

    /// Adds voltages to what the motors make of the command.
    fn add_voltage(&self, _state: &JointState, _voltage_v: &mut [f64]) {}

    /// Adds torques from outside [Nm].
    fn add_torque(&self, _state: &JointState, _plant: &Plant, _torque_nm: &mut [f64]) {}

    /// Changes the angles that the encoders read.
    fn change_reading(&self, _q_rad: &mut [f64]) {}

    /// What stands between motor and link, and at which joint (from 0).
    fn transmission(&self) -> Option<(usize, Transmission)> {
        None
    }

    /// Dry friction between motor and link [Nm], and at which joint (from 0); it acts only where
    /// a transmission stands there.
    fn transmission_friction_nm(&self) -> Option<(usize, f64)> {
        None
    }
}
