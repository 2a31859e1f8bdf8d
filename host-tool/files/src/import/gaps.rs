//! What a log needs and nothing was guessed for.

use std::collections::BTreeSet;

use super::plan::{Plan, is_command, is_position};
use crate::guess::{Command, Guess};
use crate::quantity::Role;

/// Each with the line to write; of the joints that a model has, or else of those that were seen.
pub(super) fn gaps(plan: &Plan, command: Option<Command>, joints: Option<usize>) -> Vec<String> {
    let all: Vec<&Guess> =
        plan.own.iter().chain(plan.beside.iter().flat_map(|beside| &beside.guesses)).collect();
    let mut open = Vec::new();
    // Recordings of ROS have their stamps without being told.
    if plan.topic.is_none() && !plan.own.iter().any(|guess| guess.quantity.role == Role::Time) {
        open.push("no time was found: t_s = { column = \"..\", unit = \"s\" }".to_owned());
    }
    let seen: BTreeSet<usize> =
        all.iter().map(|guess| guess.quantity.joint).filter(|joint| *joint > 0).collect();
    open.extend(joints.and_then(|count| more_joints(&seen, count)));
    let joints = joints.map_or(seen, |count| (1..=count).collect());
    if joints.is_empty() {
        open.extend(of_joint(&all, command, 1));
    }
    open.extend(joints.iter().flat_map(|joint| of_joint(&all, command, *joint)));
    open.extend(other_units(&all, command));
    if all.iter().any(|guess| guess.quantity.role == Role::Count) {
        let counts = "positions are in counts: encoder_counts_per_rev = .. before the first [table], or \
                      [joint.encoder] in the model";
        open.push(counts.to_owned());
    }
    open
}

/// Joints that the model lacks.
fn more_joints(seen: &BTreeSet<usize>, count: usize) -> Option<String> {
    let list = |numbers: &mut dyn Iterator<Item = usize>| {
        numbers.map(|number| number.to_string()).collect::<Vec<_>>().join(", ")
    };
    let beyond = list(&mut seen.iter().copied().filter(|joint| *joint > count));
    (!beyond.is_empty()).then(|| {
        let (all, kept) = (seen.len(), list(&mut (1..=count)));
        format!(
            "the logs have {all} joints, the model has {count}: give the model of that arm; or, where joints \
             {beyond} stood still, write `joints = [{kept}]` before [columns]"
        )
    })
}

/// What a joint lacks.
fn of_joint(all: &[&Guess], command: Option<Command>, joint: usize) -> Vec<String> {
    let mut of_joint = all.iter().filter(|guess| guess.quantity.joint == joint);
    let mut open = Vec::new();
    if !of_joint.clone().any(|guess| is_position(guess)) {
        open.push(line("position", joint, &format!("q{joint}_rad"), "rad"));
    }
    let is_wanted = |guess: &&&Guess| match command {
        None => is_command(guess),
        Some(Command::Goal) => guess.quantity.role == Role::Reference,
        Some(Command::Unit(_)) => guess.quantity.role == Role::Command,
    };
    if of_joint.any(|guess| is_wanted(&guess)) {
        return open;
    }
    open.push(match command {
        Some(Command::Goal) => line("goal", joint, &format!("qref{joint}_rad"), "rad"),
        Some(Command::Unit(unit)) => line("command", joint, &format!("u{joint}_{unit}"), unit),
        None => line("command", joint, &format!("u{joint}_V"), "V"),
    });
    open
}

fn line(what: &str, joint: usize, name: &str, unit: &str) -> String {
    format!(
        "no {what} of joint {joint} was found: {name} = {{ column = \"..\", unit = \"{unit}\" }}"
    )
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
