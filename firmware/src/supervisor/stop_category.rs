//! How the supervisor ends a run at a fault: with the arm braked and held, or with 0 V at once.

use super::fault::{Fault, State};

/// What the outputs do from the tick on that finds a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StopCategory {
    /// 0 V in that tick: the encoders, the converter, the clock or the amplifiers, of which a
    /// controlled stop would need all, cannot be relied on.
    Off,
    /// The reference brakes to rest, the joints are held for a second, then 0 V.
    Controlled,
}

impl Fault {
    /// How it ends a run.
    pub fn stop_category(self) -> StopCategory {
        match self {
            // Everything that controls the arm works: an arm that hangs must not drop.
            Self::LinkLost | Self::PositionLimit | Self::HoldTooLong | Self::MotorTooHot => {
                StopCategory::Controlled
            }
            Self::EncoderJump
            | Self::EncoderStuck
            | Self::TrackingError
            | Self::Speed
            | Self::Saturation
            | Self::TickOverrun
            | Self::NotFinite
            | Self::CorruptParameters
            | Self::Watchdog
            | Self::Converter
            | Self::Stalled
            | Self::EmergencyStop
            | Self::DrivePower
            | Self::OutputVoltage
            | Self::Reset
            | Self::BrownOut
            | Self::Crystal
            | Self::Clock
            | Self::Crash => StopCategory::Off,
        }
    }
}

impl State {
    /// Whether the codes go to the converter.
    pub fn drives(self) -> bool {
        matches!(self, Self::Running | Self::Stopping)
    }

    /// Whether the amplifiers are enabled, so that their power must be there.
    pub fn enables(self) -> bool {
        self.drives() || self == Self::Armed
    }
}

/// The levels of the outputs to amplifiers and brakes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DriveOutputs {
    /// The amplifiers are enabled.
    pub enable: bool,
    /// The holding brakes are released.
    pub release_brakes: bool,
}

/// A controlled stop, tick by tick.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ControlledStop {
    ticks: u32,
    period_s: f32,
}

/// Braking takes a second at most; then the joints are held for a second.
const STOP_S: f32 = 2.0;
/// What a holding brake takes to engage [s].
const BRAKE_S: f32 = 0.2;

impl ControlledStop {
    /// At the tick that finds the fault.
    pub fn new(period_s: f32) -> Self {
        Self { ticks: 0, period_s }
    }

    /// A tick later; whether 0 V are due.
    #[inline]
    pub fn is_over(&mut self) -> bool {
        self.ticks = self.ticks.saturating_add(1);
        self.elapsed_s() > STOP_S
    }

    /// Whether the brakes must engage by now.
    pub fn brakes_engage(&self) -> bool {
        self.elapsed_s() > STOP_S - BRAKE_S
    }

    fn elapsed_s(&self) -> f32 {
        self.ticks as f32 * self.period_s
    }
}
