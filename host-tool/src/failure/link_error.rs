//! What to do when the board cannot be reached, or refuses.

use std::io::ErrorKind;

use firmware::link::{BlockRefusal, Refusal, StoreRefusal};
use firmware::supervisor::fault::Implausible;

use super::Failure;
use link::LinkError;

impl From<LinkError> for Failure {
    fn from(error: LinkError) -> Self {
        Self::new(error.to_string(), hint(&error))
    }
}

fn hint(error: &LinkError) -> &'static str {
    match error {
        LinkError::NoPort { .. } => {
            "connect the board's USB port (ST-LINK), or name the line with --port: a serial \
             port, tcp:HOST:PORT or unix:SOCKET"
        }
        LinkError::ManyPorts(_) => "name the board's with --port",
        LinkError::Ports(_) => "name the board's line with --port",
        LinkError::Open { source, .. } => open_hint(source.kind()),
        LinkError::Line { .. } => "look at the cable and the board's power, then try again",
        LinkError::NoAnswer { .. } | LinkError::NoTelemetry { .. } => {
            "check that the board is powered and runs this firmware (LED LD2 flashes), and that \
             --port names its line"
        }
        LinkError::ProtocolMismatch(_) | LinkError::SchemaMismatch(_) => {
            "build tool and firmware from the same sources; `cargo xtask firmware nucleo` and \
             `rrr flash` bring the firmware up to date"
        }
        LinkError::Refused { why, .. } => refusal_hint(why),
        LinkError::NotAtRest { .. } => "hold the arm still, or look at the encoder's wiring",
        LinkError::UnexpectedAnswer(_) | LinkError::Decode(_) => {
            "build tool and firmware from the same sources"
        }
        LinkError::Encode(_) => "use fewer effects in the model file",
        LinkError::Checksum { .. } | LinkError::ReadBack { .. } => {
            "try again; if it comes back, the flash is worn"
        }
    }
}

fn open_hint(kind: ErrorKind) -> &'static str {
    match kind {
        ErrorKind::ResourceBusy => {
            "if another `rrr` has it, press Ctrl-C there, or `kill -INT` it: `rrr run` stops the \
             arm first; `fuser` with the port's name shows which program it is"
        }
        _ => "look at the name; on Linux your user must be in the group that owns the port",
    }
}

fn refusal_hint(why: &Refusal) -> &'static str {
    match why {
        Refusal::Proof => "give the board's key with --key FILE",
        Refusal::NotNow { .. } => {
            "`rrr stop` stops and disarms the board; `rrr clear-fault` leaves a fault"
        }
        Refusal::HelloFirst | Refusal::OldNumber { .. } => {
            "the board was reset, or another host talks to it; try again"
        }
        Refusal::NoParameters | Refusal::Store(StoreRefusal::Empty) => {
            "`rrr upload model.toml` gives it some"
        }
        Refusal::Implausible { why: Implausible::NoHome, .. } => {
            "bring the arm to a known posture, then `rrr home --at Q1,Q2,Q3`"
        }
        Refusal::Implausible { why: Implausible::NeverMoved, .. } => {
            "turn the joint back and forth by hand, then `rrr home`; `rrr monitor` shows whether its \
             encoder counts; a rig without this joint: `rrr upload --joints` names those it has"
        }
        Refusal::Implausible { .. } => "let the arm come to rest; look at the encoder's wiring",
        Refusal::FarFromStart { .. } => {
            "before a run the arm hangs at 0 V: let the reference begin where it comes to rest"
        }
        Refusal::EmergencyStop => "release it; without one, docs/board.md names the jumper",
        Refusal::NoDrivePower => {
            "switch the amplifiers' supply on; without that signal, docs/board.md names the jumper"
        }
        Refusal::OutsideRange { .. } => "bring the joint back by hand, inside limits_rad",
        Refusal::FaultPersists => "remove the cause first; docs/safety.md lists the faults",
        Refusal::Block(BlockRefusal::Value { .. }) => "correct the value in the model file",
        Refusal::Block(BlockRefusal::Version { .. }) => {
            "build tool and firmware from the same sources"
        }
        Refusal::StoredNotInUse => "`rrr connect` shows the fault; then reset the board",
        Refusal::Upload { .. } | Refusal::Block(_) => "try again",
        Refusal::Store(_) => "try again; if it comes back, the flash is worn",
    }
}
