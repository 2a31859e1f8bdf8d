//! The subcommands of `rrr`, one file each.
//!
//! A new one is a module with an `Arguments` struct and a `run` function, a variant
//! of [`Command`] and a line in [`Command::run`].

use clap::{CommandFactory, Parser, Subcommand};

use crate::failure::{Failure, status};

mod arm_simulation;
pub mod blind_trial;
mod board_table;
pub mod clear_fault;
pub mod completions;
pub mod connect;
pub mod demo;
pub mod design_excitation;
pub mod diagnose;
pub mod diagnose_servos;
pub mod download;
pub mod export_block;
pub mod flash;
pub mod home;
pub mod identify;
pub mod import;
pub mod inverse_dynamics;
pub mod monitor;
pub mod run;
pub mod set_key;
pub mod simulate;
mod simulate_arm;
pub mod simulate_board;
mod simulate_servos;
pub mod stop;
pub mod upload;
pub mod validate;

/// Simulates, identifies, controls and diagnoses the RRR robot.
#[derive(Debug, Parser)]
#[command(name = "rrr", version, about, propagate_version = true, after_help = status::help())]
pub struct CommandLine {
    /// Print what was found as one JSON object; words go to the standard error then.
    #[arg(long, global = true)]
    pub json: bool,
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What the tool can do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Identify the model of an unknown robot from its recorded experiments.
    Identify(identify::Arguments),
    /// Write a dataset.toml for logs of others: what their columns are, as far as it can be guessed.
    Import(import::Arguments),
    /// Compute joint torques and voltages from a model and a table of motions.
    InverseDynamics(inverse_dynamics::Arguments),
    /// Record experiments of the simulated robot.
    Simulate(simulate::Arguments),
    /// Offer a simulated board with its robot at a TCP port, to practise on; until Ctrl-C.
    ///
    /// The commands that talk to a board take its line as --port tcp:127.0.0.1:5555.
    SimulateBoard(simulate_board::Arguments),
    /// Validate a model on the held-out logs: the command and the motion that it reconstructs.
    Validate(validate::Arguments),
    /// Find what causes the gap between a real robot and its model.
    Diagnose(diagnose::Choice),
    /// Design the motion that identifies the base parameters best.
    DesignExcitation(design_excitation::Arguments),
    /// Score the diagnosis on simulated robots with hidden effects.
    BlindTrial(blind_trial::Arguments),
    /// Show which board is connected, and its state.
    Connect(connect::Arguments),
    /// Store a model on the board, for this and every later power-on.
    Upload(upload::Arguments),
    /// Fetch the board's parameters.
    Download(download::Arguments),
    /// Run an experiment on the arm and record it.
    ///
    /// Ctrl-C stops the arm before anything else and keeps the log. The exit status is 0 after
    /// a complete experiment, 130 after Ctrl-C, and 2 after a fault or any other failure.
    Run(Box<run::Arguments>),
    /// Show positions, voltages, errors, tick times and faults live, until Ctrl-C.
    Monitor(monitor::Arguments),
    /// Output 0 V and disarm the board.
    Stop(stop::Arguments),
    /// Set the position of the arm, after each reset of the board.
    Home(home::Arguments),
    /// Clear a fault whose cause is gone.
    ClearFault(clear_fault::Arguments),
    /// Set, change or remove the board's key.
    SetKey(set_key::Arguments),
    /// Write a model as the image of a parameter slot.
    ExportBlock(export_block::Arguments),
    /// Write firmware and parameters to the board through a debug probe.
    Flash(flash::Arguments),
    /// Record, identify and control a simulated robot with the firmware in QEMU.
    Demo(demo::Arguments),
    /// Print the completion script of a shell.
    Completions(completions::Arguments),
}

impl Command {
    /// Runs the command.
    ///
    /// # Errors
    /// The message for the user, and the exit status.
    pub fn run(self) -> Result<(), Failure> {
        match self {
            Self::Identify(arguments) => identify::run(&arguments),
            Self::Import(arguments) => import::run(&arguments),
            Self::InverseDynamics(arguments) => inverse_dynamics::run(&arguments),
            Self::Validate(arguments) => validate::run(&arguments),
            Self::Simulate(arguments) => simulate::run(&arguments),
            Self::SimulateBoard(arguments) => simulate_board::run(&arguments),
            Self::Diagnose(choice) => match diagnose_servos::wanted(&choice) {
                Some(arguments) => diagnose_servos::run(arguments),
                None => diagnose::run(&choice),
            },
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
            Self::Completions(arguments) => {
                completions::run(&arguments, &mut CommandLine::command())
            }
        }
    }
}
