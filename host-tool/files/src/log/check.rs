//! What every log must be, read or to be written.

use std::collections::BTreeSet;

use super::{JointLog, Log, Position};
use crate::error::{LocatedProblem, Place, Problem};
use crate::quantity::{Quantity, Role};

impl Log {
    /// Checks that there are samples of some joint, that all columns are as long as the
    /// time, that the time increases, and that every value is finite.
    ///
    /// # Errors
    /// The first problem; its line is that of the log written as `.csv`.
    pub fn check(&self) -> Result<(), LocatedProblem> {
        if self.joints.is_empty() {
            return Err(Problem::NoJoint.into());
        }
        if self.is_empty() {
            return Err(Problem::NoSamples.into());
        }
        check_finite(&self.time_s, "t_s")?;
        check_time(&self.time_s)?;
        self.joints.iter().try_for_each(|joint| joint.check(self.len()))?;
        check_numbers(&self.joints)
    }
}

impl JointLog {
    fn check(&self, rows: usize) -> Result<(), LocatedProblem> {
        let number = self.joint;
        check_length(self.position.len(), rows, self.position_column())?;
        if let Position::Radian(angles) = &self.position {
            check_finite(angles, &self.position_column())?;
        }
        let references = self.reference_rad.iter().map(|values| (values, reference_column(number)));
        for (values, name) in references.chain([(&self.command_v, command_column(number))]) {
            check_finite(values, &name)?;
            check_length(values.len(), rows, name)?;
        }
        Ok(())
    }

    /// The name of the position's column.
    pub(super) fn position_column(&self) -> String {
        match self.position {
            Position::Count(_) => count_column(self.joint),
            Position::Radian(_) => radian_column(self.joint),
        }
    }
}

/// The column of a joint's position in counts.
pub(super) fn count_column(joint: u8) -> String {
    format!("q{joint}_count")
}

/// The column of a joint's position in radians.
pub(super) fn radian_column(joint: u8) -> String {
    format!("q{joint}_rad")
}

/// The column of a joint's command.
pub(super) fn command_column(joint: u8) -> String {
    format!("u{joint}_V")
}

/// The column of a joint's reference.
pub(super) fn reference_column(joint: u8) -> String {
    format!("qref{joint}_rad")
}

fn check_numbers(joints: &[JointLog]) -> Result<(), LocatedProblem> {
    let rising = joints.windows(2).all(|pair| pair[0].joint < pair[1].joint);
    match joints.iter().find(|joint| !(1..=3).contains(&joint.joint)) {
        Some(joint) => Err(contradiction(format!("joint {} is not 1, 2 or 3", joint.joint))),
        None if rising => Ok(()),
        None => Err(contradiction("the joints are not in the order of their numbers".to_owned())),
    }
}

fn contradiction(what: String) -> LocatedProblem {
    Problem::Contradiction(what).into()
}

fn check_length(found: usize, expected: usize, column: String) -> Result<(), LocatedProblem> {
    if found == expected {
        return Ok(());
    }
    Err(Problem::UnequalLength { found, expected }.at(Place::column(column)))
}

fn check_finite(values: &[f64], column: &str) -> Result<(), LocatedProblem> {
    match values.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(row) => {
            let place = Place::line(row + 2).and_column(column);
            Err(Problem::NotFinite(values[row].to_string()).at(place))
        }
    }
}

/// Checks that the time still increases once it is written, to a nanosecond.
pub(super) fn check_written_time(time_s: &[f64]) -> Result<(), LocatedProblem> {
    let written: Vec<f64> = time_s.iter().map(|time_s| (time_s * 1e9).round() / 1e9).collect();
    check_time(&written)
}

/// Checks that columns name no joint that the model lacks; `model` says which it has.
///
/// # Errors
/// Some do.
pub fn check_joints<'a>(
    names: impl Iterator<Item = &'a str>,
    most: usize,
    model: &str,
) -> Result<(), Problem> {
    let is_of_joint =
        |quantity: &Quantity| matches!(quantity.role, Role::Position | Role::Count | Role::Command);
    let joints = names.filter_map(Quantity::of).filter(is_of_joint).map(|quantity| quantity.joint);
    let beyond: BTreeSet<usize> = joints.filter(|joint| *joint > most).collect();
    let numbers: Vec<String> = beyond.iter().map(ToString::to_string).collect();
    let found = match numbers.as_slice() {
        [] => return Ok(()),
        [one] => format!("joint {one} is"),
        several => format!("joints {} are", several.join(", ")),
    };
    Err(Problem::MoreJoints { found, model: model.to_owned() })
}

/// Checks that the time increases strictly.
pub(crate) fn check_time(time_s: &[f64]) -> Result<(), LocatedProblem> {
    match time_s.windows(2).position(|pair| pair[1] <= pair[0]) {
        None => Ok(()),
        Some(row) => {
            let (before_s, now_s) = (time_s[row], time_s[row + 1]);
            let place = Place::line(row + 3).and_column("t_s");
            Err(Problem::TimeNotIncreasing { before_s, now_s }.at(place))
        }
    }
}
