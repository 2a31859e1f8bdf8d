//! The text of a draft's list.

use super::plan::{Beside, DraftLog, Plan};
use crate::dataset::Entry;
use crate::guess::Guess;
use crate::quantity::Role;

/// The list, every guess with its reason behind it.
pub(super) fn text(plan: &Plan) -> String {
    let mut text = "format = 1\n\n# Guessed from names and values: look it through. docs/imports.md has each key.\n"
        .to_owned();
    if let Some(topic) = &plan.topic {
        text += &format!("[streams.log]\ntopic = {}\n\n", quoted(topic));
    }
    plan.beside.iter().for_each(|beside| text += &stream(beside));
    text += "[columns]\n";
    plan.own.iter().for_each(|guess| text += &line(&guess.line(""), &guess.reason));
    for beside in &plan.beside {
        let columns = beside.guesses.iter().filter(|guess| guess.quantity.role != Role::Time);
        columns.for_each(|guess| text += &line(&guess.line(&beside.name), &guess.reason));
    }
    plan.logs.iter().for_each(|log| text += &entry(log));
    text
}

fn line(line: &str, reason: &str) -> String {
    format!("{line}    # {reason}\n")
}

fn quoted(text: &str) -> String {
    toml::Value::from(text).to_string()
}

fn stream(beside: &Beside) -> String {
    let mut text = format!("[streams.{}]\n", beside.name);
    if let Some(topic) = &beside.topic {
        text += &format!("topic = {}\n", quoted(topic));
    }
    let is_time = |guess: &&Guess| guess.quantity.role == Role::Time;
    if let Some(time) = beside.guesses.iter().find(is_time) {
        text += &line(&time.line("").replacen("t_s", "time", 1), &time.reason);
    }
    text + "\n"
}

fn entry(log: &DraftLog) -> String {
    let entry =
        Entry { file: log.file.clone(), experiment: log.experiment, role: log.role, joint: None };
    let table = toml::to_string(&entry).unwrap_or_default();
    let mut text = format!("\n[[log]]\n{table}");
    if let Some((column, value)) = &log.episode {
        text += &format!("rows = {{ {} = {value} }}\n", quoted(column));
    }
    if let Some((stream, file)) = &log.beside {
        text += &format!("files = {{ {stream} = {} }}\n", quoted(file));
    }
    text
}
