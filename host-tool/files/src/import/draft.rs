//! What the files seem to be: streams, columns, logs and their roles.

use std::collections::BTreeSet;
use std::path::Path;

use super::look::{File, StreamLook, files};
use super::pairs::partner;
use super::text::text;
use crate::dataset::{Experiment, Role as LogRole};
use crate::error::FileError;
use crate::guess::{Command, Guess, UNNAMED, guess};
use crate::quantity::Role;

/// A list for files of others.
#[derive(Clone, Debug, PartialEq)]
pub struct Draft {
    /// The text of `dataset.toml`, each guess with its reason.
    pub text: String,
    /// What was guessed, line by line.
    pub guessed: Vec<String>,
    /// What could not be, with the line to write.
    pub open: Vec<String>,
}

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

/// A draft for the files at or below `path`, as seen from the directory of the list; `command` is what
/// the drives take, where a model tells it, and `joints` their number.
///
/// # Errors
/// There is no such path, or nothing in it can be read.
pub fn draft(
    path: &Path,
    directory: &Path,
    command: Option<Command>,
    joints: Option<usize>,
) -> Result<Draft, FileError> {
    let (files, mut open) = files(path)?;
    let main = main_file(&files, command);
    let (plan, left) = plan(main, &files, directory, command);
    open.extend(left);
    open.extend(gaps(&plan, command, joints));
    let lines = |guesses: &[Guess], stream: &str| -> Vec<String> {
        guesses
            .iter()
            .map(|guess| format!("{}    # {}", guess.line(stream), guess.reason))
            .collect()
    };
    let mut guessed = lines(&plan.own, "");
    plan.beside.iter().for_each(|beside| guessed.extend(lines(&beside.guesses, &beside.name)));
    Ok(Draft { text: text(&plan), guessed, open })
}

/// How many positions a stream seems to have.
fn positions(stream: &StreamLook, command: Option<Command>) -> usize {
    guess(&stream.columns, command).iter().filter(|guess| is_position(guess)).count()
}

fn is_position(guess: &Guess) -> bool {
    matches!(guess.quantity.role, Role::Position | Role::Count)
}

fn is_command(guess: &Guess) -> bool {
    matches!(guess.quantity.role, Role::Command | Role::Reference)
}

/// The first of the files with most positions.
fn main_file(files: &[File], command: Option<Command>) -> &File {
    let most = |file: &File| -> usize {
        file.streams.iter().map(|stream| positions(stream, command)).max().unwrap_or(0)
    };
    let best = files.iter().map(most).max().unwrap_or(0);
    files.iter().find(|file| most(file) == best).unwrap_or(&files[0])
}

fn plan(
    main: &File,
    files: &[File],
    directory: &Path,
    command: Option<Command>,
) -> (Plan, Vec<String>) {
    let mut streams: Vec<&StreamLook> = main.streams.iter().collect();
    // Of equals the first.
    streams.sort_by_key(|stream| std::cmp::Reverse(positions(stream, command)));
    let own_stream = streams.remove(0);
    let mut plan = Plan { own: guess(&own_stream.columns, command), ..Plan::default() };
    plan.topic = (!own_stream.name.is_empty()).then(|| own_stream.name.clone());
    let other_file = partner(main, files).filter(|other| other.shape() != main.shape());
    if let Some(other) = other_file {
        other.streams.iter().for_each(|stream| plan.add(stream, true, command));
    } else {
        streams.into_iter().for_each(|stream| plan.add(stream, false, command));
    }
    let mut left = Vec::new();
    let partners: BTreeSet<&Path> = files
        .iter()
        .filter_map(|file| partner(file, files))
        .map(|file| file.path.as_path())
        .collect();
    for file in files {
        if file.shape() == main.shape() {
            plan.add_logs(file, files, directory);
        } else if !partners.contains(file.path.as_path()) {
            left.push(format!(
                "{} has other columns and is not in the list; import it on its own",
                file.path.display()
            ));
        }
    }
    plan.hold_out();
    (plan, left)
}

impl Plan {
    /// Takes in a stream if commands come from it.
    fn add(&mut self, stream: &StreamLook, has_file: bool, command: Option<Command>) {
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
        // What drives report need not stand for commands now.
        self.own.retain(|guess| !guess.reason.contains(UNNAMED));
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

    fn add_logs(&mut self, file: &File, files: &[File], directory: &Path) {
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
    fn hold_out(&mut self) {
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

/// What a log needs and nothing was guessed for.
fn gaps(plan: &Plan, command: Option<Command>, joints: Option<usize>) -> Vec<String> {
    let all: Vec<&Guess> =
        plan.own.iter().chain(plan.beside.iter().flat_map(|beside| &beside.guesses)).collect();
    let has = |role: fn(&Guess) -> bool, joint| {
        all.iter().any(|guess| role(guess) && guess.quantity.joint == joint)
    };
    let mut open = Vec::new();
    // Recordings of ROS have their stamps without being told.
    if plan.topic.is_none() && !plan.own.iter().any(|guess| guess.quantity.role == Role::Time) {
        open.push("no time was found: t_s = { column = \"..\", unit = \"s\" }".to_owned());
    }
    let most = all.iter().map(|guess| guess.quantity.joint).max().unwrap_or(0);
    let unit = match command {
        Some(Command::Unit(unit)) => unit,
        _ => "V",
    };
    for joint in 1..=joints.unwrap_or(most).max(1) {
        if !has(is_position, joint) {
            open.push(format!(
                "no position of joint {joint} was found: q{joint}_rad = {{ column = \"..\", unit = \"rad\" }}"
            ));
        }
        match (command, has(is_command, joint)) {
            (_, true) => {}
            (Some(Command::Goal), false) => open.push(format!(
                "no goal of joint {joint} was found: qref{joint}_rad = {{ column = \"..\", unit = \"rad\" }}"
            )),
            (_, false) => open.push(format!(
                "no command of joint {joint} was found: u{joint}_{unit} = {{ column = \"..\", unit = \"{unit}\" }}"
            )),
        }
    }
    open.extend(other_units(&all, command));
    if all.iter().any(|guess| guess.quantity.role == Role::Count) {
        open.push(
            "positions are in counts: encoder_counts_per_rev = .. before the first [table], or \
             [joint.encoder] in the model"
                .to_owned(),
        );
    }
    open
}

/// Commands in another unit than the model's drives take.
fn other_units(all: &[&Guess], command: Option<Command>) -> Vec<String> {
    let Some(Command::Unit(unit)) = command else { return Vec::new() };
    let is_other =
        |guess: &&&Guess| guess.quantity.role == Role::Command && guess.quantity.unit != unit;
    let line = |guess: &&Guess| {
        let (joint, column) = (guess.quantity.joint, &guess.column);
        format!(
            "{} is in {}, but the model's drive takes {unit}: u{joint}_{unit} = {{ column = \"{column}\", \
             scale = .. }} with {unit} per {} of it",
            guess.quantity.name(),
            guess.quantity.unit,
            guess.quantity.unit
        )
    };
    all.iter().filter(is_other).map(line).collect()
}
