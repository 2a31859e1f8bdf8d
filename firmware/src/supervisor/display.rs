//! States and faults in words, for the host's messages and the board's log.

use core::fmt::{Display, Formatter, Result};

use super::fault::{Fault, FaultRecord, Implausible, State};

impl State {
    /// Every state.
    pub const ALL: [Self; 6] =
        [Self::Boot, Self::Disarmed, Self::Armed, Self::Running, Self::Faulted, Self::Stopping];

    /// The name that messages use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Boot => "boot",
            Self::Disarmed => "disarmed",
            Self::Armed => "armed",
            Self::Running => "running",
            Self::Faulted => "faulted",
            Self::Stopping => "stopping",
        }
    }
}

impl Display for State {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.write_str(self.name())
    }
}

impl Fault {
    /// Every fault.
    pub const ALL: [Self; 23] = [
        Self::EncoderJump,
        Self::EncoderStuck,
        Self::TrackingError,
        Self::Speed,
        Self::Saturation,
        Self::TickOverrun,
        Self::NotFinite,
        Self::LinkLost,
        Self::CorruptParameters,
        Self::Watchdog,
        Self::Converter,
        Self::Stalled,
        Self::EmergencyStop,
        Self::DrivePower,
        Self::PositionLimit,
        Self::HoldTooLong,
        Self::Crash,
        Self::MotorTooHot,
        Self::OutputVoltage,
        Self::Reset,
        Self::BrownOut,
        Self::Crystal,
        Self::Clock,
    ];

    /// The name that messages use.
    pub fn name(self) -> &'static str {
        match self {
            Self::EncoderJump => "encoder jump",
            Self::EncoderStuck => "encoder stuck",
            Self::TrackingError => "tracking error",
            Self::Speed => "speed",
            Self::Saturation => "saturation too long",
            Self::TickOverrun => "tick overrun",
            Self::NotFinite => "value not finite",
            Self::LinkLost => "link lost",
            Self::CorruptParameters => "corrupt parameters",
            Self::Watchdog => "watchdog",
            Self::Converter => "converter",
            Self::Stalled => "stalled",
            Self::EmergencyStop => "emergency stop",
            Self::DrivePower => "drive power",
            Self::PositionLimit => "position limit",
            Self::HoldTooLong => "hold too long",
            Self::Crash => "crash",
            Self::MotorTooHot => "motor too hot",
            Self::OutputVoltage => "output voltage",
            Self::Reset => "reset while armed",
            Self::BrownOut => "supply failed while armed",
            Self::Crystal => "crystal failed",
            Self::Clock => "clock wrong",
        }
    }

    /// The number on the line and in the documentation, from 1 up; that of a fault never changes.
    pub fn number(self) -> u8 {
        self as u8 + 1
    }

    /// The unit of a record's value and limit; empty where there are none.
    pub fn unit(self) -> &'static str {
        match self {
            Self::EncoderJump => "rad from one tick to the next",
            Self::EncoderStuck => "rad of reference, or V, while the encoder stands still",
            Self::TrackingError => "rad from the reference",
            Self::Speed => "rad/s",
            Self::Saturation => "s at the limit, less a quarter of the pauses",
            Self::Stalled => {
                "V beyond gravity at a joint that stands still (amplifier off, brake, obstacle or \
                 encoder)"
            }
            Self::MotorTooHot => "V all the time, as warm as it is",
            Self::OutputVoltage => "V between the output and its code",
            Self::HoldTooLong => "s of holding after the reference",
            Self::PositionLimit => "rad, where it would come to rest",
            Self::LinkLost => "s without a word from the host",
            Self::TickOverrun
            | Self::NotFinite
            | Self::CorruptParameters
            | Self::Watchdog
            | Self::Converter
            | Self::EmergencyStop
            | Self::DrivePower
            | Self::Reset
            | Self::BrownOut
            | Self::Crystal
            | Self::Clock
            | Self::Crash => "",
        }
    }
}

impl Display for Fault {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.write_str(self.name())
    }
}

impl FaultRecord {
    /// The record of a crash at a program counter, with the processor's fault status.
    pub fn of_crash(tick: u32, program_counter: u32, fault_status: u32) -> Self {
        let (value, limit) = (f32::from_bits(program_counter), f32::from_bits(fault_status));
        Self { fault: Fault::Crash, joint: 0, tick, value, limit }
    }

    /// Program counter and fault status of a crash.
    pub fn crash(&self) -> Option<(u32, u32)> {
        (self.fault == Fault::Crash).then(|| (self.value.to_bits(), self.limit.to_bits()))
    }
}

impl Display for FaultRecord {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        write!(f, "{}", self.fault)?;
        if self.joint > 0 {
            write!(f, " at joint {}", self.joint)?;
        }
        if let Some((counter, status)) = self.crash() {
            write!(f, " at {counter:#010x}, fault status {status:#010x}")?;
        }
        if !self.fault.unit().is_empty() {
            let (value, limit, unit) = (self.value, self.limit, self.fault.unit());
            let at =
                if self.fault == Fault::PositionLimit && value < limit { "least" } else { "most" };
            write!(f, ": {value:.4} {unit}, at {at} {limit:.4} allowed")?;
        }
        write!(f, " (tick {})", self.tick)
    }
}

impl Display for Implausible {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.write_str(match self {
            Self::NotSettled => "the estimates have not settled yet",
            Self::Moving => "the joint moves; it must be at rest",
            Self::Disagrees => "the velocity estimate disagrees with the encoder",
            Self::Jumped => "the encoder has jumped a moment ago",
            Self::NotFinite => "an estimate is not a finite number",
            Self::NoHome => {
                "its position has not been set since power-on or since its encoder failed"
            }
            Self::NeverMoved => "its encoder has not moved since power-on or since it failed",
        })
    }
}
