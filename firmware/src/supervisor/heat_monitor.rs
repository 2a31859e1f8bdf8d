//! The heat of a motor's winding, from the squares of its commands (I2t).

use crate::ParameterBlock;

/// Share of what a motor bears above which its commands are limited.
const DERATED_FROM: f32 = 0.75;
/// The limit when all of it is used up, as a multiple of the command that it bears for ever: more
/// than that, so that a motor that needs it all the time is found.
const LAST_LIMIT: f32 = 1.1;

/// What the motor of one joint bears, tick by tick.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Bearable {
    continuous_v: f32,
    /// Of a tick.
    gain: f32,
    /// The block's limit of the command [V].
    command_limit_v: f32,
    /// How much less for each share of heat beyond the first ones [V].
    slope_v: f32,
}

/// The heat of one motor: the mean square of its commands, the older the less it counts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct HeatMonitor {
    bearable: Option<Bearable>,
    mean_square_v2: f32,
}

impl HeatMonitor {
    /// For joint `index` (0 to 2) of a checked block, cold.
    pub fn new(block: &ParameterBlock, index: usize) -> Self {
        let command_limit_v = block.command_limit_v;
        let bearable = block.safety.heating[index].map(|motor| {
            let last_v = (LAST_LIMIT * motor.continuous_v).min(command_limit_v);
            Bearable {
                continuous_v: motor.continuous_v,
                gain: block.sample_period_s / motor.time_constant_s,
                command_limit_v,
                slope_v: (command_limit_v - last_v) / (1.0 - DERATED_FROM),
            }
        });
        Self { bearable, mean_square_v2: 0.0 }
    }

    /// The same motor with what another block says of it: a motor does not cool by an upload.
    pub fn warmed_as(self, before: &Self) -> Self {
        Self { mean_square_v2: before.mean_square_v2, ..self }
    }

    /// The same constants, cold.
    pub fn fresh(&self) -> Self {
        Self { mean_square_v2: 0.0, ..*self }
    }

    /// Takes the command of a tick; what the next one is limited to, if that is less than the block
    /// says [V].
    #[inline]
    pub fn limit_after(&mut self, command_v: f32) -> Option<f32> {
        let bearable = self.bearable.as_ref()?;
        self.mean_square_v2 += bearable.gain * (command_v * command_v - self.mean_square_v2);
        let beyond = self.share(bearable) - DERATED_FROM;
        let most = 1.0 - DERATED_FROM;
        let counted = if beyond < most { beyond } else { most };
        (beyond > 0.0).then_some(bearable.command_limit_v - bearable.slope_v * counted)
    }

    /// Whether the motor has had more than it bears.
    #[inline]
    pub fn is_too_hot(&self) -> bool {
        self.bearable.as_ref().is_some_and(|bearable| self.share(bearable) > 1.0)
    }

    /// Whether the commands of a warm motor are limited.
    pub fn is_limiting(&self) -> bool {
        self.bearable.as_ref().is_some_and(|bearable| self.share(bearable) > DERATED_FROM)
    }

    /// The heat as the command that makes it in the long run, and the one that the motor bears [V].
    pub fn volts(&self) -> (f32, f32) {
        let continuous_v = self.bearable.map_or(0.0, |bearable| bearable.continuous_v);
        (libm::sqrtf(self.mean_square_v2), continuous_v)
    }

    #[inline]
    fn share(&self, bearable: &Bearable) -> f32 {
        self.mean_square_v2 / (bearable.continuous_v * bearable.continuous_v)
    }
}
