//! A log: what the joints did, sample by sample.

use std::path::Path;

use super::bytes;
use super::error::{FileError, Problem};

mod board_message;
mod check;
mod from_table;
mod joint_message;
mod mcap_records;
mod read_mcap;
mod write_csv;
mod write_mcap;

pub use board_message::BoardSample;

/// A recorded log.
///
/// Row `i` of a joint holds the position sampled at `time_s[i]` and the voltage that
/// the amplifier got during the interval that begins there.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Log {
    /// Sample times [s], strictly increasing, not always evenly spaced.
    pub time_s: Vec<f64>,
    /// The joints that the log holds, in the order of their numbers.
    pub joints: Vec<JointLog>,
}

/// One joint's columns of a log, each as long as [`Log::time_s`].
#[derive(Clone, Debug, PartialEq)]
pub struct JointLog {
    /// Which joint, 1 to 3.
    pub joint: u8,
    /// Measured position.
    pub position: Position,
    /// Commanded voltage after quantisation and limits [V].
    pub command_v: Vec<f64>,
    /// Reference position [rad].
    pub reference_rad: Option<Vec<f64>>,
}

/// A joint's measured position.
#[derive(Clone, Debug, PartialEq)]
pub enum Position {
    /// Encoder counts since power-on, over many turns.
    Count(Vec<i64>),
    /// Radians.
    Radian(Vec<f64>),
}

/// The formats of a log, which its name's ending tells.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Format {
    Csv,
    Mcap,
}

impl Format {
    fn of(path: &Path) -> Result<Self, FileError> {
        let name = path.to_string_lossy().to_ascii_lowercase();
        if name.ends_with(".csv") || name.ends_with(".csv.gz") {
            Ok(Self::Csv)
        } else if name.ends_with(".mcap") {
            Ok(Self::Mcap)
        } else {
            Err(Problem::UnknownExtension.in_file(path))
        }
    }
}

impl Log {
    /// Reads a `.csv`, `.csv.gz` or `.mcap` file; columns of other names are ignored.
    ///
    /// # Errors
    /// Names the file, the line and column, what is wrong, and the cure.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, FileError> {
        let path = path.as_ref();
        Self::of(Format::of(path)?, path, &bytes::read(path)?)
    }

    /// The log in the bytes of a file of that name.
    ///
    /// # Errors
    /// As of [`Log::read`].
    pub fn parse(path: impl AsRef<Path>, bytes: Vec<u8>) -> Result<Self, FileError> {
        let path = path.as_ref();
        Self::of(Format::of(path)?, path, &bytes::content(path, bytes)?)
    }

    fn of(format: Format, path: &Path, content: &[u8]) -> Result<Self, FileError> {
        match format {
            Format::Csv => from_table::of(path, content),
            Format::Mcap => read_mcap::of(path, content),
        }
    }

    /// Writes a `.csv`, `.csv.gz` or `.mcap` file, whole or not at all.
    ///
    /// # Errors
    /// A log that would not read back, or a path that cannot be written.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), FileError> {
        self.write_with_board(path, &[])
    }

    /// [`Log::write`] with what the board told beside its joints, which only `.mcap` holds.
    ///
    /// # Errors
    /// As of [`Log::write`].
    pub fn write_with_board(
        &self,
        path: impl AsRef<Path>,
        board: &[BoardSample],
    ) -> Result<(), FileError> {
        let path = path.as_ref();
        let format = Format::of(path)?;
        self.check()
            .and_then(|()| check::check_written_time(&self.time_s))
            .map_err(|fault| fault.in_file(path))?;
        match format {
            Format::Csv => write_csv::write(self, path),
            Format::Mcap => write_mcap::write(self, board, path),
        }
    }

    /// How many samples each joint has.
    pub fn len(&self) -> usize {
        self.time_s.len()
    }

    /// Whether there is no sample.
    pub fn is_empty(&self) -> bool {
        self.time_s.is_empty()
    }

    /// Time from the first sample to the last [s].
    pub fn duration_s(&self) -> f64 {
        match (self.time_s.first(), self.time_s.last()) {
            (Some(first), Some(last)) => last - first,
            _ => 0.0,
        }
    }

    /// The usual time from sample to sample [s]: the median, which gaps do not move.
    /// `None` below two samples.
    pub fn sample_period_s(&self) -> Option<f64> {
        let mut steps: Vec<f64> = self.time_s.windows(2).map(|pair| pair[1] - pair[0]).collect();
        if steps.is_empty() {
            return None;
        }
        let middle = steps.len() / 2;
        let (_, median, _) = steps.select_nth_unstable_by(middle, f64::total_cmp);
        Some(*median)
    }

    /// A joint by its number, 1 to 3.
    pub fn joint(&self, number: u8) -> Option<&JointLog> {
        self.joints.iter().find(|joint| joint.joint == number)
    }

    /// The log's only joint; `None` when there are several.
    pub fn only_joint(&self) -> Option<&JointLog> {
        match self.joints.as_slice() {
            [joint] => Some(joint),
            _ => None,
        }
    }

    /// Whether a position is in encoder counts, for which the counts per turn are needed.
    pub fn needs_counts_per_rev(&self) -> bool {
        self.joints.iter().any(|joint| matches!(joint.position, Position::Count(_)))
    }
}

impl JointLog {
    /// The position in radians; `counts_per_rev` is not used where the log has radians.
    pub fn position_rad(&self, counts_per_rev: f64) -> Vec<f64> {
        self.position.radians(counts_per_rev)
    }
}

impl Position {
    /// How many samples there are.
    pub fn len(&self) -> usize {
        match self {
            Self::Count(counts) => counts.len(),
            Self::Radian(angles) => angles.len(),
        }
    }

    /// Whether there is no sample.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The position in radians; `counts_per_rev` is not used where it is in radians already.
    pub fn radians(&self, counts_per_rev: f64) -> Vec<f64> {
        let radians_per_count = std::f64::consts::TAU / counts_per_rev;
        match self {
            Self::Count(counts) => counts.iter().map(|&c| c as f64 * radians_per_count).collect(),
            Self::Radian(angles) => angles.clone(),
        }
    }
}
