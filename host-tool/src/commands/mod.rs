//! The subcommands of `rrr`, one file each.
//!
//! A new one is a module with an `Arguments` struct and a `run` function, a variant
//! of [`Command`] and a line in [`Command::run`].

use std::path::Path;

use clap::{Parser, Subcommand};

use files::FileError;
use simulation::board::BoardError;

pub mod blind_trial;
pub mod block_choice;
pub mod clear_fault;
pub mod completions;
pub mod connect;
pub mod demo;
pub mod design_excitation;
pub mod diagnose;
pub mod download;
pub mod export_block;
pub mod flash;
pub mod home;
pub mod identify;
pub mod interrupt;
pub mod inverse_dynamics;
pub mod key_file;
pub mod link_choice;
pub mod monitor;
pub mod output;
pub mod run;
pub mod set_key;
pub mod simulate;
pub mod stop;
pub mod upload;
pub mod validate;

/// Simulates the RRR robot, identifies it from its logs and judges the model.
#[derive(Debug, Parser)]
#[command(name = "rrr", version, about, propagate_version = true)]
pub struct CommandLine {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What the tool can do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Find the model of an unknown robot from its recorded experiments.
    Identify(identify::Arguments),
    /// Compute joint torques and voltages from a model and a table of motions.
    InverseDynamics(inverse_dynamics::Arguments),
    /// Record experiments of the simulated robot.
    Simulate(simulate::Arguments),
    /// Judge a model on the logs held out: the command and the motion that it reconstructs.
    Validate(validate::Arguments),
    /// Find what causes the gap between a real robot and its model.
    Diagnose(diagnose::Choice),
    /// Design the motion that identifies the base parameters best.
    DesignExcitation(design_excitation::Arguments),
    /// Judge the diagnosis on robots whose hidden effects it is not told.
    BlindTrial(blind_trial::Arguments),
    /// Tell what is at the board's line, and how it is.
    Connect(connect::Arguments),
    /// Store a model on the board, for this and every later power-on.
    Upload(upload::Arguments),
    /// Fetch the board's parameters.
    Download(download::Arguments),
    /// Do an experiment with the arm and record it.
    ///
    /// Ctrl-C stops the arm before anything else and keeps the log. The exit status is 0 after
    /// the experiment's own end, 130 after Ctrl-C, and 2 after a fault or whatever went wrong.
    Run(Box<run::Arguments>),
    /// Look at positions, voltages, errors, ticks and faults as they change, until Ctrl-C.
    Monitor(monitor::Arguments),
    /// Take the voltage away and disarm the board.
    Stop(stop::Arguments),
    /// Tell the board where the arm is, after each of its resets.
    Home(home::Arguments),
    /// Let the board leave a fault whose cause is gone.
    ClearFault(clear_fault::Arguments),
    /// Give the board a key, change it or take it away.
    SetKey(set_key::Arguments),
    /// Write a model as the image of a parameter slot.
    ExportBlock(export_block::Arguments),
    /// Put firmware and parameters onto the board through a debug probe.
    Flash(flash::Arguments),
    /// Record, identify and control a simulated robot with the firmware in QEMU.
    Demo(demo::Arguments),
    /// Write what a shell needs to complete this tool's command line.
    Completions(completions::Arguments),
}

impl Command {
    /// Runs the command.
    ///
    /// # Errors
    /// What the user is told before the tool ends with the failure's exit status.
    pub fn run(self) -> Result<(), Failure> {
        match self {
            Self::Identify(arguments) => identify::run(&arguments),
            Self::InverseDynamics(arguments) => inverse_dynamics::run(&arguments),
            Self::Validate(arguments) => validate::run(&arguments),
            Self::Simulate(arguments) => simulate::run(&arguments),
            Self::Diagnose(arguments) => diagnose::run(&arguments),
            Self::DesignExcitation(arguments) => design_excitation::run(&arguments),
            Self::BlindTrial(arguments) => blind_trial::run(&arguments),
            Self::Connect(arguments) => connect::run(&arguments),
            Self::Upload(arguments) => upload::run(&arguments),
            Self::Download(arguments) => download::run(&arguments),
            Self::Run(arguments) => run::run(&arguments),
            Self::Monitor(arguments) => monitor::run(&arguments),
            Self::Stop(arguments) => stop::run(&arguments),
            Self::Home(arguments) => home::run(&arguments),
            Self::ClearFault(arguments) => clear_fault::run(&arguments),
            Self::SetKey(arguments) => set_key::run(&arguments),
            Self::ExportBlock(arguments) => export_block::run(&arguments),
            Self::Flash(arguments) => flash::run(&arguments),
            Self::Demo(arguments) => demo::run(&arguments),
            Self::Completions(arguments) => completions::run(&arguments),
        }
    }
}

/// The exit status after bad input, of clap's as well, and after whatever went wrong.
pub const BAD_INPUT: u8 = 2;
/// The exit status after Ctrl-C, by custom 128 and the signal's number.
pub const INTERRUPTED: u8 = 130;

/// What a user is told when a command fails: what is wrong, and what to do about it.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{message}")]
pub struct Failure {
    /// What is wrong, with the place and the offending value.
    pub message: String,
    /// What to do about it.
    pub hint: String,
    /// The exit status.
    pub status: u8,
}

impl Failure {
    /// A failure in words.
    pub fn new(message: impl Into<String>, hint: impl Into<String>) -> Self {
        Self { message: message.into(), hint: hint.into(), status: BAD_INPUT }
    }

    /// The user ended the command with Ctrl-C; what it has come to so far.
    pub fn interrupted(message: impl Into<String>) -> Self {
        Self { message: message.into(), hint: String::new(), status: INTERRUPTED }
    }

    /// The lines that go to the terminal.
    pub fn report(&self) -> String {
        match self.hint.as_str() {
            _ if self.status == INTERRUPTED => format!("interrupted: {}", self.message),
            "" => format!("error: {}", self.message),
            hint => format!("error: {}\nhint: {hint}", self.message),
        }
    }
}

/// Makes a directory for what a command writes, and those above it.
///
/// # Errors
/// It cannot be made.
pub fn create_directory(directory: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(directory).map_err(|error| {
        let message = format!("{}: cannot be made a directory: {error}", directory.display());
        Failure::new(message, "give another --out")
    })
}

impl From<FileError> for Failure {
    fn from(error: FileError) -> Self {
        Self::new(error.to_string(), error.cure())
    }
}

impl From<BoardError> for Failure {
    fn from(error: BoardError) -> Self {
        let hint = match &error {
            BoardError::Block(_) => "correct the value in the model file",
            BoardError::Start { .. } => "`cargo xtask setup` installs QEMU and builds what it runs",
            _ => "rebuild the image with `cargo xtask firmware qemu`",
        };
        Self::new(error.to_string(), hint)
    }
}
