//! Logs of arms from tables of comma-separated numbers.

use std::path::Path;

use super::columns::Columns;
use super::{ArmJointLog, ArmLog};
use crate::arm_file::{ArmFile, ArmJoint};
use crate::error::{FileError, LocatedProblem, Place, Problem};
use crate::log::check::{check_joints, check_time};
use crate::mapping::{self, Needs, View};
use crate::table::{Kind, Table, Values};

impl ArmLog {
    /// Reads a `.csv` or `.csv.gz` log of an arm, all of whose joints must be in it.
    ///
    /// # Errors
    /// Names the file, line and column, what is wrong, and a remedy.
    pub fn read(path: impl AsRef<Path>, arm: &ArmFile) -> Result<Self, FileError> {
        let path = path.as_ref();
        let columns = columns_of(arm);
        let table = Table::read(path, |name| kind_of(&columns, name))?;
        log_from(table, arm, &columns).map_err(|fault| fault.in_file(path))
    }

    /// Reads a log of any file that can be read, by a mapping; a `.csv` log with no mapping as
    /// [`ArmLog::read`] does. With it comes what was done to it.
    ///
    /// # Errors
    /// Names the file and what is wrong; where columns are missing, those found and lines to write.
    pub fn read_mapped(
        directory: &Path,
        file: &str,
        view: &View,
        arm: &ArmFile,
    ) -> Result<(Self, Vec<String>), FileError> {
        let path = directory.join(file);
        let columns = columns_of(arm);
        let required = required(&columns);
        let needs = Needs { required: &required, beside: "" };
        let read = if view.is_empty() && is_plain(file) {
            Self::read(&path, arm).map(|log| (log, Vec::new()))
        } else {
            let mapped = mapping::read(directory, file, view, needs)?;
            let log = log_from(mapped.table, arm, &columns).map_err(LocatedProblem::without_line);
            log.map(|log| (log, mapped.notes)).map_err(|fault| fault.in_file(&path))
        };
        read.map_err(|error| match &error.problem {
            Problem::MissingColumn(name) => {
                mapping::explain(directory, file, view, vec![name.clone()], needs)
            }
            Problem::FieldCount { .. } if mapping::lacks_time(&path) => {
                mapping::explain(directory, file, view, Vec::new(), needs)
            }
            _ => error,
        })
    }
}

/// Whether a file is text by its name.
fn is_plain(file: &str) -> bool {
    let name = file.to_ascii_lowercase();
    name.ends_with(".csv") || name.ends_with(".csv.gz")
}

fn columns_of(arm: &ArmFile) -> Vec<Columns> {
    (1..).zip(&arm.joints).map(|(number, joint)| Columns::of(number, joint)).collect()
}

/// What a log of the arm must have.
fn required(columns: &[Columns]) -> Vec<String> {
    let of_joint = |joint: &Columns| {
        [format!("{} (or {})", joint.position, joint.count), joint.command.clone()]
    };
    ["t_s".to_owned()].into_iter().chain(columns.iter().flat_map(of_joint)).collect()
}

fn kind_of(columns: &[Columns], name: &str) -> Kind {
    if columns.iter().any(|joint| joint.count == name) {
        Kind::Count
    } else if name == "t_s" || columns.iter().any(|joint| joint.has(name)) {
        Kind::Float
    } else {
        Kind::Skipped
    }
}

fn log_from(
    mut table: Table,
    arm: &ArmFile,
    columns: &[Columns],
) -> Result<ArmLog, LocatedProblem> {
    let time_s = table.take_float("t_s")?;
    if table.rows() == 0 {
        return Err(Problem::NoSamples.into());
    }
    check_time(&time_s)?;
    let last = arm.joints.len();
    check_joints(table.names(), last, &format!("the model ends with joint {last}"))?;
    let joints = (1..).zip(arm.joints.iter().zip(columns));
    let joints =
        joints.map(|(number, (joint, columns))| of_joint(&mut table, number, joint, columns));
    Ok(ArmLog { time_s, joints: joints.collect::<Result<_, _>>()? })
}

fn of_joint(
    table: &mut Table,
    number: usize,
    joint: &ArmJoint,
    columns: &Columns,
) -> Result<ArmJointLog, LocatedProblem> {
    Ok(ArmJointLog {
        position: position(table, number, joint, columns)?,
        command: command(table, number, columns)?,
        reference: table.take_float(&columns.reference).ok(),
        velocity: table.take_float(&columns.velocity).ok(),
        torque: table.take_float(&columns.torque).ok(),
    })
}

fn position(
    table: &mut Table,
    number: usize,
    joint: &ArmJoint,
    columns: &Columns,
) -> Result<Vec<f64>, LocatedProblem> {
    let Columns { position, count, .. } = columns;
    match (table.take(count), table.take(position)) {
        (Some(_), Some(_)) => Err(Problem::BothPositions(number as u8).into()),
        (None, Some(Values::Float(positions))) => Ok(positions),
        (Some(Values::Count(counts)), None) => {
            let step = joint.count_step().ok_or_else(|| {
                let what = format!(
                    "{count} is in counts, but [joint.encoder] of joint {number} is not in the model"
                );
                Problem::Contradiction(what).at(Place::column(count))
            })?;
            Ok(counts.into_iter().map(|count| count as f64 * step).collect())
        }
        _ => Err(Problem::MissingColumn(format!("{position} (or {count})")).into()),
    }
}

fn command(
    table: &mut Table,
    number: usize,
    columns: &Columns,
) -> Result<Vec<f64>, LocatedProblem> {
    let missing = match table.take_float(&columns.command) {
        Ok(command) => return Ok(command),
        Err(missing) => missing,
    };
    match table.names().find(|name| columns.others.iter().any(|other| other == name)) {
        Some(other) => {
            let what = format!(
                "the command of joint {number} is in {other}, but its drive in the model takes {}",
                columns.command
            );
            Err(Problem::Contradiction(what).at(Place::column(other)))
        }
        None => Err(missing.into()),
    }
}
