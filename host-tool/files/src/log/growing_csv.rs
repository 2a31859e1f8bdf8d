//! A log that is written as it comes: what is in it stays, whatever becomes of the process.

use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use super::Log;
use super::write_csv::{header, push_line};
use crate::error::{FileError, Problem};

/// A `.csv` file that grows with its log; each row is handed to the system at once.
#[derive(Debug)]
pub struct GrowingCsv {
    path: PathBuf,
    file: File,
    /// Rows that are in the file.
    rows: usize,
}

impl GrowingCsv {
    /// A new file with the columns of this log, whose rows follow.
    ///
    /// # Errors
    /// The file is there already, or cannot be made.
    pub fn create(path: impl AsRef<Path>, log: &Log) -> Result<Self, FileError> {
        let path = path.as_ref().to_owned();
        let mut options = OpenOptions::new();
        let made = options.write(true).create_new(true).open(&path).and_then(|mut file| {
            file.write_all(header(log).as_bytes())?;
            Ok(file)
        });
        let file = made.map_err(|error| Problem::Unwritable(error).in_file(&path))?;
        Ok(Self { path, file, rows: 0 })
    }

    /// Adds the rows that the log has got since the last time.
    ///
    /// # Errors
    /// The disk does not take them.
    pub fn follow(&mut self, log: &Log) -> Result<(), FileError> {
        if log.len() <= self.rows {
            return Ok(());
        }
        let mut lines = String::new();
        (self.rows..log.len()).for_each(|row| push_line(&mut lines, log, row));
        let written = self.file.write_all(lines.as_bytes());
        written.map_err(|error| Problem::Unwritable(error).in_file(&self.path))?;
        self.rows = log.len();
        Ok(())
    }

    /// Takes the file away: the log is kept elsewhere, or nobody wants it.
    ///
    /// # Errors
    /// The directory does not let it go.
    pub fn remove(self) -> Result<(), FileError> {
        drop(self.file);
        let removed = std::fs::remove_file(&self.path);
        removed.map_err(|error| Problem::Unwritable(error).in_file(&self.path))
    }
}
