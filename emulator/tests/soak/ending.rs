//! How sessions end.

use firmware::supervisor::Fault;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// Stop, then disarm, as a host does.
    Stop,
    /// The host falls silent.
    Silence,
    /// The emergency stop is pressed in a run, and let go.
    EmergencyStop,
    /// The amplifiers lose their power in a run, and have it back.
    DrivePower,
    /// The same while armed, before a run.
    DrivePowerWhileArmed,
    /// The amplifiers are off and nothing says so, while the joints are held.
    Stall,
    /// The reference ends, and nobody ends the run.
    Hold,
    /// The reference leaves a joint's range.
    Range,
    /// The converter loses its analog supply, and has it back.
    Converter,
    /// An encoder jumps.
    Jump,
    /// The tick comes late.
    Overrun,
    /// The thread hangs: the watchdog resets the board.
    Watchdog,
    /// The processor meets an instruction that is none.
    Crash,
    /// A host that asks for no limit of its silence falls silent: the rig's limit holds.
    Alone,
    /// Noise on the line in a run, uploads in it that are refused; then it is stopped.
    Noise,
    /// The pin NRST is pulled in a run.
    PinReset,
    /// The supply falls for a moment in a run.
    BrownOut,
    /// The clock that ticks goes wrong, and is right again.
    Clock,
    /// Disarmed, then power off and on: the block that was committed is there.
    PowerCycle,
}

impl Ending {
    pub const ALL: [Self; 19] = [
        Self::Stop,
        Self::Silence,
        Self::EmergencyStop,
        Self::DrivePower,
        Self::DrivePowerWhileArmed,
        Self::Stall,
        Self::Hold,
        Self::Range,
        Self::Converter,
        Self::Jump,
        Self::Overrun,
        Self::Watchdog,
        Self::Crash,
        Self::Alone,
        Self::Noise,
        Self::PinReset,
        Self::BrownOut,
        Self::Clock,
        Self::PowerCycle,
    ];

    /// Those that no other test of the image has.
    pub const ONLY_HERE: [Self; 5] =
        [Self::Silence, Self::DrivePowerWhileArmed, Self::Stall, Self::Hold, Self::Range];

    /// The fault that it must end in.
    pub fn fault(self) -> Option<Fault> {
        match self {
            Self::Silence | Self::Alone => Some(Fault::LinkLost),
            Self::EmergencyStop => Some(Fault::EmergencyStop),
            Self::DrivePower | Self::DrivePowerWhileArmed => Some(Fault::DrivePower),
            Self::Stall => Some(Fault::Stalled),
            Self::Hold => Some(Fault::HoldTooLong),
            Self::Range => Some(Fault::PositionLimit),
            Self::Converter => Some(Fault::Converter),
            Self::Jump => Some(Fault::EncoderJump),
            Self::Overrun => Some(Fault::TickOverrun),
            Self::Watchdog => Some(Fault::Watchdog),
            Self::Crash => Some(Fault::Crash),
            Self::PinReset => Some(Fault::Reset),
            Self::BrownOut => Some(Fault::BrownOut),
            Self::Clock => Some(Fault::Clock),
            Self::Stop | Self::Noise | Self::PowerCycle => None,
        }
    }

    /// Milliseconds from what happens to 0 V at the latest; none where the arm is braked first.
    pub fn zero_within_ms(self) -> Option<f64> {
        match self {
            Self::EmergencyStop | Self::DrivePower => Some(2.1),
            Self::Jump => Some(1.1),
            Self::Overrun => Some(5.0),
            Self::Converter => Some(65.0),
            Self::Watchdog => Some(34.0),
            Self::Clock => Some(300.0),
            Self::Crash | Self::PinReset | Self::BrownOut => Some(0.01),
            _ => None,
        }
    }
}
