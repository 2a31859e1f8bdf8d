//! Logs from tables of comma-separated numbers.

use std::path::Path;

use super::check::{
    check_joints, check_time, command_column, count_column, radian_column, reference_column,
};
use super::{JointLog, Log, Position};
use crate::error::{FileError, LocatedProblem, Problem};
use crate::table::{Kind, Table, Values};

/// The log in a table's text; the path is for messages.
pub(super) fn of(path: &Path, text: &[u8]) -> Result<Log, FileError> {
    Table::parse(text, kind_of).and_then(log_from).map_err(|fault| fault.in_file(path))
}

/// How a log's column is read, by its name.
pub(super) fn kind_of(name: &str) -> Kind {
    let is = |column: fn(u8) -> String| (1..=3).any(|joint| column(joint) == name);
    if is(count_column) {
        Kind::Count
    } else if name == "t_s" || is(radian_column) || is(command_column) || is(reference_column) {
        Kind::Float
    } else {
        Kind::Skipped
    }
}

/// The log that a table's columns make.
pub(super) fn log_from(mut table: Table) -> Result<Log, LocatedProblem> {
    let time_s = table.take_float("t_s")?;
    if table.rows() == 0 {
        return Err(Problem::NoSamples.into());
    }
    check_time(&time_s)?;
    check_joints(table.names(), 3, "a robot of format 1 has joints 1 to 3 alone")?;
    let mut joints = Vec::new();
    for joint in 1..=3 {
        joints.extend(joint_from(&mut table, joint)?);
    }
    if joints.is_empty() {
        return Err(Problem::NoJoint.into());
    }
    Ok(Log { time_s, joints })
}

/// A joint's columns; `None` where the table has no position and no command of it.
fn joint_from(table: &mut Table, joint: u8) -> Result<Option<JointLog>, Problem> {
    let command = table.take_float(&command_column(joint));
    let position = match position_from(table, joint)? {
        Some(position) => position,
        None if command.is_err() => return Ok(None),
        None => {
            let either = format!("{} (or {})", count_column(joint), radian_column(joint));
            return Err(Problem::MissingColumn(either));
        }
    };
    let reference_rad = table.take_float(&reference_column(joint)).ok();
    Ok(Some(JointLog { joint, position, command_v: command?, reference_rad }))
}

fn position_from(table: &mut Table, joint: u8) -> Result<Option<Position>, Problem> {
    let counts = table.take(&count_column(joint));
    let angles = table.take(&radian_column(joint));
    match (counts, angles) {
        (Some(_), Some(_)) => Err(Problem::BothPositions(joint)),
        (Some(Values::Count(counts)), None) => Ok(Some(Position::Count(counts))),
        (None, Some(Values::Float(angles))) => Ok(Some(Position::Radian(angles))),
        _ => Ok(None),
    }
}
