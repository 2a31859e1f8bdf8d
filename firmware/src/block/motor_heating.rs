//! What the winding of a motor bears.

use model::ParameterError;
use model::parameter::named;
use serde::{Deserialize, Serialize};

/// What a motor bears for ever, and how fast it warms. Its amplifier sets a current in proportion to
/// the command, so that losses go with the command's square.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MotorHeating {
    /// Command whose current the motor bears for ever [V].
    pub continuous_v: f32,
    /// Time constant with which the winding warms [s].
    pub time_constant_s: f32,
}

impl MotorHeating {
    /// Checks that both are above zero, and the time within what a winding can have.
    pub fn check(&self, joint: u8) -> Result<(), ParameterError> {
        named("motor continuous_V", self.continuous_v).of_joint(joint).positive()?;
        named("motor time_constant_s", self.time_constant_s).of_joint(joint).require(
            (0.1..=100_000.0).contains(&self.time_constant_s),
            "be from 0.1 to 100000 s",
        )?;
        Ok(())
    }

    /// Whether a motor that bears this bears what another one does.
    pub fn bears_less_than(&self, other: &Self) -> bool {
        self.continuous_v <= other.continuous_v && self.time_constant_s <= other.time_constant_s
    }
}
