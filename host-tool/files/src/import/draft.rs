//! What the files seem to be: streams, columns, logs and their roles.

use std::collections::BTreeSet;
use std::path::Path;

use super::gaps::gaps;
use super::look::{File, StreamLook, files};
use super::pairs::partner;
use super::plan::{Plan, is_position};
use super::text::text;
use crate::error::FileError;
use crate::guess::{Command, Guess, guess};
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
    let mut guessed: Vec<String> = plan.own.iter().map(|guess| said(guess, "")).collect();
    for beside in &plan.beside {
        guessed.extend(beside.guesses.iter().map(|guess| said(guess, &beside.name)));
    }
    Ok(Draft { text: text(&plan), guessed, open })
}

/// A guess's line and its reason; times of streams stand under the streams.
fn said(guess: &Guess, stream: &str) -> String {
    let line = match (guess.quantity.role, stream) {
        (Role::Time, stream) if !stream.is_empty() => {
            format!("[streams.{stream}] {}", guess.line("").replacen("t_s", "time", 1))
        }
        _ => guess.line(stream),
    };
    format!("{line}    # {}", guess.reason)
}

/// How many positions a stream seems to have.
fn positions(stream: &StreamLook, command: Option<Command>) -> usize {
    guess(&stream.columns, command).iter().filter(|guess| is_position(guess)).count()
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
