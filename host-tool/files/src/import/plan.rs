//! What is guessed of a folder: the streams and columns of its logs, their roles.

use std::path::Path;

use super::look::{File, StreamLook};
use super::pairs::partner;
use crate::dataset::{Experiment, Role as LogRole};
use crate::guess::{Command, Guess, UNNAMED, guess};
use crate::quantity::Role;

/// A stream beside the log's own.
pub(super) struct Beside {
    pub(super) name: String,
    pub(super) topic: Option<String>,
    /// Its guesses, the first for the time where there is one.
    pub(super) guesses: Vec<Guess>,
    /// Whether it lies in a file of its own.
    pub(super) has_file: bool,
}

/// A log of the list.
pub(super) struct DraftLog {
    pub(super) file: String,
    pub(super) role: LogRole,
    pub(super) experiment: Experiment,
    /// File of the stream beside, by its name.
    pub(super) beside: Option<(String, String)>,
    /// Column and value that its rows have.
    pub(super) episode: Option<(String, i64)>,
}

/// All that is guessed.
#[derive(Default)]
pub(super) struct Plan {
    pub(super) topic: Option<String>,
    pub(super) own: Vec<Guess>,
    pub(super) beside: Vec<Beside>,
    pub(super) logs: Vec<DraftLog>,
}

impl Plan {
    /// Takes in a stream if commands come from it.
    pub(super) fn add(&mut self, stream: &StreamLook, has_file: bool, command: Option<Command>) {
        let new = guess(&stream.columns, command);
        let is_new = |guess: &&Guess| {
            let there = self.own.iter().chain(self.beside.iter().flat_map(|b| &b.guesses));
            let of_place = |old: &&Guess| {
                old.quantity.role == guess.quantity.role
                    && old.quantity.joint == guess.quantity.joint
            };
            !there.filter(of_place).any(|old| !old.reason.contains(UNNAMED))
        };
        let of_commands =
            new.iter().filter(|guess| is_command(guess) && !guess.reason.contains(UNNAMED));
        let mut guesses: Vec<Guess> = of_commands.filter(is_new).cloned().collect();
        if guesses.is_empty() {
            return;
        }
        // What drives report need not stand for commands now, but may show them.
        let reported: Vec<Guess> =
            self.own.extract_if(.., |guess| guess.reason.contains(UNNAMED)).collect();
        for guess in &mut guesses {
            let same = reported.iter().find(|seen| seen.quantity == guess.quantity);
            guess.copy = same.map(|seen| seen.column.clone());
        }
        if has_file {
            guesses.splice(..0, new.into_iter().filter(|guess| guess.quantity.role == Role::Time));
        }
        let name = match self.beside.len() {
            0 => "commands".to_owned(),
            more => format!("commands-{}", more + 1),
        };
        let topic = (!stream.name.is_empty()).then(|| stream.name.clone());
        self.beside.push(Beside { name, topic, guesses, has_file });
    }

    /// Takes in the logs of a file.
    pub(super) fn add_logs(&mut self, file: &File, files: &[File], directory: &Path) {
        let relative = |file: &File| {
            file.path.strip_prefix(directory).unwrap_or(&file.path).to_string_lossy().into_owned()
        };
        let beside = self.beside.iter().find(|beside| beside.has_file);
        let other =
            beside.and_then(|beside| Some((beside.name.clone(), relative(partner(file, files)?))));
        let episodes = match &file.episodes {
            Some((column, values)) => values.iter().map(|v| Some((column.clone(), *v))).collect(),
            None => vec![None],
        };
        let name = relative(file);
        for episode in episodes {
            self.logs.push(DraftLog {
                role: role(&name),
                experiment: experiment(&name),
                file: name.clone(),
                beside: other.clone(),
                episode,
            });
        }
    }

    /// Holds the last quarter of the logs out where no name says which.
    pub(super) fn hold_out(&mut self) {
        let count = self.logs.len();
        if count > 1 && self.logs.iter().all(|log| log.role == LogRole::Train) {
            let held = count.div_ceil(4);
            self.logs[count - held..].iter_mut().for_each(|log| log.role = LogRole::Holdout);
        }
    }
}

fn role(name: &str) -> LogRole {
    let name = name.to_lowercase();
    let is_held = ["holdout", "hold_out", "test", "valid"].iter().any(|word| name.contains(word));
    if is_held { LogRole::Holdout } else { LogRole::Train }
}

fn experiment(name: &str) -> Experiment {
    let name = name.to_lowercase().replace('_', "-");
    let known = [
        ("constant-velocity", Experiment::ConstantVelocity),
        ("friction-excitation", Experiment::FrictionExcitation),
        ("presliding-noise", Experiment::PreslidingNoise),
        ("driven-noise", Experiment::DrivenNoise),
        ("excitation", Experiment::Excitation),
        ("slow", Experiment::Slow),
    ];
    known.into_iter().find(|(word, _)| name.contains(word)).map_or(Experiment::Task, |(_, e)| e)
}

/// Whether it is a position.
pub(super) fn is_position(guess: &Guess) -> bool {
    matches!(guess.quantity.role, Role::Position | Role::Count)
}

/// Whether it is a command or a goal.
pub(super) fn is_command(guess: &Guess) -> bool {
    matches!(guess.quantity.role, Role::Command | Role::Reference)
}
