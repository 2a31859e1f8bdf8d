//! A log as a file, in the format given by its file extension.

use std::path::Path;

use super::{Log, McapDetails, check, from_table, read_mcap, write_csv, write_mcap};
use crate::bytes;
use crate::error::{FileError, LocatedProblem, Problem};
use crate::mapping::{self, Needs, View};

/// The formats of a log, by file extension.
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

/// What a log needs beside the time, for messages.
const BESIDE_TIME: &str =
    "q1_rad (or q1_count), u1_V and the like of each further joint of the robot";

impl Log {
    /// Reads a `.csv`, `.csv.gz` or `.mcap` file; columns of other names are ignored.
    ///
    /// # Errors
    /// Names the file, the line and column, what is wrong, and a remedy.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, FileError> {
        let path = path.as_ref();
        Self::of(Format::of(path)?, path, &bytes::read(path)?)
    }

    /// Reads a log of any file that can be read, by a mapping; a log of the tool's own formats, with no
    /// mapping, as [`Log::read`] does. With it comes what was done to it.
    ///
    /// # Errors
    /// Names the file and what is wrong; where columns are missing, those found and lines to write.
    pub fn read_mapped(
        directory: &Path,
        file: &str,
        view: &View,
    ) -> Result<(Self, Vec<String>), FileError> {
        let path = directory.join(file);
        let required = ["t_s".to_owned()];
        let needs = Needs { required: &required, beside: BESIDE_TIME };
        let explain = |missing: &str| {
            mapping::explain(directory, file, view, vec![missing.to_owned()], needs)
        };
        let read = if view.is_empty() && Format::of(&path).is_ok() {
            Self::read(&path).map(|log| (log, Vec::new()))
        } else {
            let mapped = mapping::read(directory, file, view, needs)?;
            let log = from_table::log_from(mapped.table).map_err(LocatedProblem::without_line);
            log.map(|log| (log, mapped.notes)).map_err(|fault| fault.in_file(&path))
        };
        read.map_err(|error| match &error.problem {
            Problem::MissingColumn(name) => explain(name),
            Problem::NoJoint => explain("q1_rad (or q1_count)"),
            Problem::FieldCount { .. } if mapping::lacks_time(&path) => explain("t_s"),
            _ => error,
        })
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
        self.write_with(path, &McapDetails::default())
    }

    /// [`Log::write`] with what is known beside the log, which only `.mcap` holds.
    ///
    /// # Errors
    /// As of [`Log::write`].
    pub fn write_with(
        &self,
        path: impl AsRef<Path>,
        details: &McapDetails,
    ) -> Result<(), FileError> {
        let path = path.as_ref();
        let format = Format::of(path)?;
        self.check()
            .and_then(|()| check::check_written_time(&self.time_s))
            .map_err(|fault| fault.in_file(path))?;
        match format {
            Format::Csv => write_csv::write(self, path),
            Format::Mcap => write_mcap::write(self, details, path),
        }
    }
}
