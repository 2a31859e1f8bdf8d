//! Which board a command talks to, with which key, and what to do when it does not work.

use std::io::ErrorKind;
use std::path::PathBuf;

use clap::Args;
use firmware::link::{BlockRefusal, Key, Refusal, Report, StoreRefusal};
use firmware::supervisor::fault::Implausible;

use super::Failure;
use super::key_file::read_key;
use link::{Address, Client, LinkError};

/// Names the key's file where --key does not.
pub const KEY_VARIABLE: &str = "RRR_KEY_FILE";

/// Where the board is, and the key to it.
#[derive(Clone, Debug, Default, Args)]
pub struct LinkChoice {
    /// The board's line: a serial port or pty, tcp:HOST:PORT, or unix:SOCKET; not needed
    /// where there is just one ST-LINK or one serial port at USB.
    #[arg(long, value_name = "PORT")]
    pub port: Option<String>,
    /// The board's key: a file of 64 hexadecimal digits, as `rrr set-key` makes it; without
    /// the option, the file that RRR_KEY_FILE names.
    #[arg(long, value_name = "FILE")]
    pub key: Option<PathBuf>,
}

impl LinkChoice {
    /// Opens the line and says Hello.
    ///
    /// # Errors
    /// No line, no board, one of another build, or a key file that is none.
    pub fn connect(&self) -> Result<Client, Failure> {
        let key = self.key()?;
        Ok(Client::connect(&self.address()?, key)?)
    }

    /// The same for what needs no key: the file that RRR_KEY_FILE names is not read.
    ///
    /// # Errors
    /// As of [`LinkChoice::connect`], where --key names the file.
    pub fn connect_to_look(&self) -> Result<Client, Failure> {
        self.key.as_deref().map(read_key).transpose()?;
        self.connect_to_stop()
    }

    /// The same to stop the arm: no key file keeps one from that.
    ///
    /// # Errors
    /// No line, no board, or one of another build.
    pub fn connect_to_stop(&self) -> Result<Client, Failure> {
        Ok(Client::connect(&self.address()?, None)?)
    }

    fn address(&self) -> Result<Address, LinkError> {
        self.port.as_deref().map_or_else(Address::find, |text| Ok(Address::of(text)))
    }

    /// The key, where the user names a file.
    ///
    /// # Errors
    /// The file cannot be read, or holds something else.
    pub fn key(&self) -> Result<Option<Key>, Failure> {
        let named = std::env::var_os(KEY_VARIABLE).filter(|name| !name.is_empty());
        let path = self.key.clone().or(named.map(PathBuf::from));
        path.as_deref().map(read_key).transpose()
    }
}

/// Whether the board keeps its key to itself, in words.
pub fn openness(report: &Report) -> &'static str {
    match report.has_key {
        true => "needs the key to upload, tell home, arm, run and clear faults",
        false => "open: whoever has the line may upload and arm; `rrr set-key` changes that",
    }
}

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
        LinkError::Broke { .. } => "look at the cable and the board's power, then try again",
        LinkError::Silent { .. } | LinkError::NoTelemetry { .. } => {
            "look whether the board is powered and runs this firmware (lamp LD2 flashes), and \
             whether --port names its line"
        }
        LinkError::OtherProtocol(_) | LinkError::OtherMessages(_) => {
            "build tool and firmware from the same sources; `cargo xtask firmware nucleo` and \
             `rrr flash` bring the firmware up to date"
        }
        LinkError::Refused { why, .. } => refusal_hint(why),
        LinkError::NotAtRest { .. } => "hold the arm still, or look at the encoder's wiring",
        LinkError::OtherAnswer(_) => "build tool and firmware from the same sources",
        LinkError::Checksum { .. } | LinkError::ReadBack { .. } => {
            "try again; if it comes back, the flash is worn"
        }
    }
}

fn open_hint(kind: ErrorKind) -> &'static str {
    match kind {
        ErrorKind::ResourceBusy => {
            "if another `rrr` has it, press Ctrl-C there, or `kill -INT` it: `rrr run` stops the \
             arm first; `fuser` with the port's name tells which program it is"
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
            "the board was reset, or somebody else talks to it; try again"
        }
        Refusal::NoParameters | Refusal::Store(StoreRefusal::Empty) => {
            "`rrr upload model.toml` gives it some"
        }
        Refusal::Implausible { why: Implausible::NoHome, .. } => {
            "bring the arm to a place that you know, then `rrr home --at Q1,Q2,Q3`"
        }
        Refusal::Implausible { why: Implausible::NeverMoved, .. } => {
            "turn the joint to and fro by hand, then `rrr home`; `rrr monitor` shows whether its \
             encoder counts; a rig without this joint: `rrr upload --joints` names those it has"
        }
        Refusal::Implausible { .. } => "let the arm come to rest; look at the encoder's wiring",
        Refusal::FarFromStart { .. } => {
            "the arm is at 0 V before it runs: let the reference begin where it rests by itself, hanging"
        }
        Refusal::FaultPersists => "remove the cause first; docs/safety.md lists the faults",
        Refusal::Block(BlockRefusal::Value { .. }) => "correct the value in the model file",
        Refusal::Block(BlockRefusal::Version { .. }) => {
            "build tool and firmware from the same sources"
        }
        Refusal::StoredNotInUse => "`rrr connect` tells the fault; then reset the board",
        Refusal::Upload { .. } | Refusal::Block(_) => "try again",
        Refusal::Store(_) => "try again; if it comes back, the flash is worn",
    }
}
