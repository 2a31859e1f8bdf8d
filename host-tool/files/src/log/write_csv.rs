//! Logs as comma-separated numbers.

use std::fmt::Write as _;
use std::io::Write;
use std::path::Path;

use flate2::Compression;
use flate2::write::GzEncoder;

use super::check::{command_column, reference_column};
use super::{JointLog, Log, Position};
use crate::error::{FileError, Problem};
use crate::number::push_decimal;
use crate::replace::replace_file;

/// Decimals of a time: milliseconds at least, nanoseconds at most.
const TIME_DECIMALS: (usize, usize) = (3, 9);
/// Decimals of a voltage: a 16-bit converter's step is 0.0003 V.
const VOLTAGE_DECIMALS: (usize, usize) = (6, 6);
/// Decimals of an angle in radians.
const ANGLE_DECIMALS: (usize, usize) = (6, 12);

/// Writes a `.csv` or, where the name ends so, a `.csv.gz` file.
pub(super) fn write(log: &Log, path: &Path) -> Result<(), FileError> {
    let packed = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("gz"));
    replace_file(path, |file| {
        let written = if packed {
            let mut packer = GzEncoder::new(file, Compression::default());
            write_lines(log, &mut packer).and_then(|()| packer.finish().map(drop))
        } else {
            write_lines(log, file)
        };
        written.map_err(Problem::Unwritable)
    })
}

fn write_lines(log: &Log, out: &mut impl Write) -> std::io::Result<()> {
    let mut line = header(log);
    out.write_all(line.as_bytes())?;
    for row in 0..log.len() {
        line.clear();
        push_line(&mut line, log, row);
        out.write_all(line.as_bytes())?;
    }
    Ok(())
}

/// The line of a row of the log.
pub(super) fn push_line(line: &mut String, log: &Log, row: usize) {
    push_number(line, log.time_s[row], TIME_DECIMALS);
    for joint in &log.joints {
        line.push(',');
        push_position(line, &joint.position, row);
    }
    for joint in &log.joints {
        line.push(',');
        push_number(line, joint.command_v[row], VOLTAGE_DECIMALS);
    }
    for reference_rad in log.joints.iter().filter_map(|joint| joint.reference_rad.as_ref()) {
        line.push(',');
        push_number(line, reference_rad[row], ANGLE_DECIMALS);
    }
    line.push('\n');
}

pub(super) fn header(log: &Log) -> String {
    let positions = log.joints.iter().map(JointLog::position_column);
    let commands = log.joints.iter().map(|joint| command_column(joint.joint));
    let with_reference = log.joints.iter().filter(|joint| joint.reference_rad.is_some());
    let references = with_reference.map(|joint| reference_column(joint.joint));
    let names = ["t_s".to_owned()].into_iter().chain(positions).chain(commands).chain(references);
    names.collect::<Vec<_>>().join(",") + "\n"
}

fn push_number(line: &mut String, value: f64, (least, most): (usize, usize)) {
    push_decimal(line, value, least, most);
}

fn push_position(line: &mut String, position: &Position, row: usize) {
    match position {
        // Writing to a string cannot fail.
        Position::Count(counts) => drop(write!(line, "{}", counts[row])),
        Position::Radian(angles) => push_number(line, angles[row], ANGLE_DECIMALS),
    }
}
