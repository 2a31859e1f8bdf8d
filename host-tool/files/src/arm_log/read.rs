//! Logs of arms from tables of comma-separated numbers.

use std::path::Path;

use super::columns::Columns;
use super::{ArmJointLog, ArmLog};
use crate::arm_file::{ArmFile, ArmJoint};
use crate::error::{FileError, LocatedProblem, Place, Problem};
use crate::log::check::check_time;
use crate::table::{Kind, Table, Values};

impl ArmLog {
    /// Reads a `.csv` or `.csv.gz` log of an arm, all of whose joints must be in it.
    ///
    /// # Errors
    /// Names the file, line and column, what is wrong, and a remedy.
    pub fn read(path: impl AsRef<Path>, arm: &ArmFile) -> Result<Self, FileError> {
        let path = path.as_ref();
        let joints = (1..).zip(&arm.joints);
        let columns: Vec<Columns> = joints.map(|(number, j)| Columns::of(number, j)).collect();
        let table = Table::read(path, |name| kind_of(&columns, name))?;
        log_from(table, arm, &columns).map_err(|fault| fault.in_file(path))
    }
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
