//! States and faults; types only, as the schema hash is taken of this text.

use serde::{Deserialize, Serialize};

/// What the board is doing. The outputs are at 0 V in every state but Running and Stopping.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum State {
    /// Parameters are looked for, the converter is checked.
    #[default]
    Boot,
    /// At rest; parameters may be changed.
    Disarmed,
    /// Ready to run, still at 0 V.
    Armed,
    /// The controller's codes go to the converter.
    Running,
    /// Something was wrong; left by an explicit clear and by nothing else, not even a reset.
    Faulted,
    /// A fault is latched; the arm is braked to rest and held for a moment before it is Faulted.
    Stopping,
}

/// Why the supervisor ended a run, or does not let one begin. Its number on the line is its
/// place here and never changes: new ones come last.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Fault {
    /// An encoder moved further in a tick than its joint can. Value and limit in rad per tick.
    EncoderJump,
    /// An encoder does not move although its joint is commanded to. Value and limit in rad of
    /// the reference's travel, or in V where there is no reference.
    EncoderStuck,
    /// The joint is too far from its reference [rad].
    TrackingError,
    /// The joint is too fast [rad/s].
    Speed,
    /// The command was at its limit for too long [s], a quarter of the pauses taken off.
    Saturation,
    /// A tick was not done when the next one was due.
    TickOverrun,
    /// A command or an estimate is not a finite number.
    NotFinite,
    /// The host was silent for too long in a run that it must watch [s].
    LinkLost,
    /// The stored parameters are damaged, both slots of them, or those in use have changed.
    CorruptParameters,
    /// The watchdog has reset the board.
    Watchdog,
    /// The converter does not answer as it should.
    Converter,
    /// A joint does not move although its voltage, less gravity's, exceeds friction [V].
    Stalled,
    /// The emergency stop was pressed while armed.
    EmergencyStop,
    /// The amplifiers lost their power while armed.
    DrivePower,
    /// A joint would have left its range [rad].
    PositionLimit,
    /// The joints were held for too long after their reference had ended [s].
    HoldTooLong,
    /// The processor met an instruction or an access that it cannot carry out, or a panic. The bits
    /// of value and limit are the program counter and the fault status (CFSR).
    Crash,
    /// A motor has had more current than it bears for ever, for so long that it is hot [V].
    MotorTooHot,
    /// An output of the converter, measured, is not what its code says [V off].
    OutputVoltage,
    /// The board was reset while it was armed: the pin NRST, a debugger.
    Reset,
    /// The board's supply failed while it was armed.
    BrownOut,
    /// The crystal failed while the board was on.
    Crystal,
    /// The clock that ticks and the one of the watchdog are further apart than both may be wrong.
    Clock,
}

/// The first cause, with the figures that made it one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FaultRecord {
    /// What was wrong.
    pub fault: Fault,
    /// The joint, 1 to 3, or 0 for the board.
    pub joint: u8,
    /// Ticks since power-on.
    pub tick: u32,
    /// What was found, in the unit that the fault names; 0 where there is no figure.
    pub value: f32,
    /// What is allowed.
    pub limit: f32,
}

/// Why the board does not arm: an estimate that cannot be right.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Implausible {
    /// The estimates have not settled since power-on or since parameters were changed.
    NotSettled,
    /// The joint moves: it must be at rest when the board is armed.
    Moving,
    /// The velocity estimate disagrees with the encoder's travel.
    Disagrees,
    /// The encoder has jumped within the time that the estimates look back on.
    Jumped,
    /// An estimate is not a finite number.
    NotFinite,
    /// The encoder counts from where the joint was at power-on, and its position has not been
    /// set since then, or since the encoder failed.
    NoHome,
    /// The encoder has not moved since power-on, or since it failed: it may be dead.
    NeverMoved,
}
