//! A guess for every column that may be one of a log's.

use super::Guess;
use super::joints::joints;
use super::looked::Looked;
use super::roles::role;
use super::units::units;
use crate::quantity::{Quantity, Role};

/// What the drives of a model take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Command {
    /// A command in this unit.
    Unit(&'static str),
    /// A goal: position servos.
    Goal,
}

/// Reason of a guess that takes what drives report for their command.
pub const UNNAMED: &str = "no column is named a command";

/// The likely columns of a stream, each of a log's columns once, the first that may be it; what the
/// drives take, where a model tells it.
pub fn guess(columns: &[Looked], command: Option<Command>) -> Vec<Guess> {
    let of_role = |wanted: Role| -> Vec<&Looked> {
        columns.iter().filter(|column| role(&column.words()) == Some(wanted)).collect()
    };
    let mut guesses = time(&of_role(Role::Time));
    let (mut commands, torques) = (of_role(Role::Command), of_role(Role::Torque));
    let mut references = of_role(Role::Reference);
    if command == Some(Command::Goal) && references.is_empty() {
        references = std::mem::take(&mut commands);
    }
    let has_command = !commands.is_empty() || !references.is_empty();
    guesses.extend(of_group(Role::Position, &of_role(Role::Position), None));
    guesses.extend(of_group(Role::Reference, &references, None));
    guesses.extend(of_group(Role::Velocity, &of_role(Role::Velocity), None));
    guesses.extend(of_group(Role::Command, &commands, command));
    if has_command || command == Some(Command::Goal) {
        guesses.extend(of_group(Role::Torque, &torques, None));
    } else {
        // What drives report stands for their command where nothing else does.
        let mut reported = of_group(Role::Command, &torques, command);
        reported.iter_mut().for_each(|guess| guess.reason += &format!("; {UNNAMED}"));
        guesses.extend(reported);
    }
    guesses
}

fn time(columns: &[&Looked]) -> Vec<Guess> {
    let guess = |column: &&Looked| {
        let (_, unit, reason) = units(Role::Time, &column.words(), column)?;
        Some(Guess {
            quantity: Quantity::TIME,
            column: column.name.clone(),
            unit,
            reason,
            copy: None,
        })
    };
    columns.iter().find_map(guess).into_iter().collect()
}

/// The columns of one role: those whose names tell of it by the same words as the first.
fn of_group(role: Role, columns: &[&Looked], command: Option<Command>) -> Vec<Guess> {
    let alike = alike(columns);
    let names: Vec<String> = alike.iter().map(|column| column.full_name()).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let guess = |(column, joint): (&&Looked, usize)| {
        let (log_unit, unit, reason) = units(role, &column.words(), column)?;
        let (log_unit, unit) = match command {
            Some(Command::Unit(command)) if reason.contains("no unit") => (command, command),
            _ => (log_unit, unit),
        };
        let quantity = quantity(role, joint, log_unit)?;
        Some(Guess { quantity, column: column.name.clone(), unit, reason, copy: None })
    };
    alike.iter().zip(joints(&names)).filter_map(guess).collect()
}

fn quantity(role: Role, joint: usize, unit: &str) -> Option<Quantity> {
    match (role, unit) {
        (Role::Position, "count") => Quantity::new(Role::Count, joint, unit),
        (Role::Reference, "count") => None,
        (Role::Torque, "V" | "A") => None,
        _ => Quantity::new(role, joint, unit),
    }
}

/// Columns whose names tell of their role by the same words as the first.
fn alike<'a>(columns: &[&'a Looked]) -> Vec<&'a Looked> {
    let Some(first) = columns.first() else { return Vec::new() };
    let shape = |column: &Looked| -> Vec<String> {
        let told = column.words();
        told.into_iter().filter(|word| role(std::slice::from_ref(word)).is_some()).collect()
    };
    columns.iter().copied().filter(|column| shape(column) == shape(first)).collect()
}
