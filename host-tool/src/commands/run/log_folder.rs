//! The folder that runs are recorded into, a data set.

use std::path::{Path, PathBuf};

use crate::failure::Failure;
use crate::output_files::create_directory;
use crate::terminal::output::try_print_line;
use files::dataset::LIST_NAME;
use files::log::unix_ns;
use files::{Dataset, Entry, GrowingCsv, McapDetails, Problem};
use link::Recorder;
use rig::Plan;

/// A data set that grows by one log a run.
///
/// What was made a directory for it and holds nothing in the end is taken away again.
#[derive(Debug)]
pub struct LogFolder {
    directory: PathBuf,
    /// From the innermost on.
    made: Vec<PathBuf>,
}

impl LogFolder {
    /// The data set that is there, or will be; nothing is made yet.
    ///
    /// # Errors
    /// A dataset.toml that cannot be used.
    pub fn open(directory: &Path) -> Result<Self, Failure> {
        if directory.join(LIST_NAME).exists() {
            Dataset::read(directory)?;
        }
        Ok(Self { directory: directory.to_owned(), made: Vec::new() })
    }

    /// Makes the directory and looks whether it can take a log of this plan, before anything
    /// moves.
    ///
    /// # Errors
    /// No file can be made in the directory, or the list there cannot take the log.
    pub fn prepare(&mut self, plan: &Plan, counts_per_rev: f64) -> Result<(), Failure> {
        let is_there = |path: &&Path| path.exists() || path.as_os_str().is_empty();
        let missing = self.directory.ancestors().take_while(|path| !is_there(path));
        self.made = missing.map(Path::to_owned).collect();
        create_directory(&self.directory)?;
        tempfile::Builder::new()
            .prefix(&format!(".rrr-{}-", plan.name))
            .tempfile_in(&self.directory)
            .map_err(|error| Problem::Unwritable(error).in_file(&self.directory))?;
        Dataset::appended(&self.directory, &self.entry(plan), counts_per_rev)?;
        Ok(())
    }

    /// A file for the rows of a run as they come; it is there even if this process is killed, and it
    /// is not in dataset.toml.
    ///
    /// # Errors
    /// No file can be made in the directory.
    pub fn grow(&self, name: &str, recorder: &Recorder) -> Result<GrowingCsv, Failure> {
        let is_free = |name: &String| !self.directory.join(name).exists();
        let numbered = (2..).map(|number| format!("{name}-{number}{UNFINISHED}"));
        let first = std::iter::once(format!("{name}{UNFINISHED}"));
        let free = first.chain(numbered).find(is_free).unwrap_or_default();
        Ok(GrowingCsv::create(self.directory.join(free), &recorder.log)?)
    }

    /// Writes a run's log as CSV and MCAP, and its table of dataset.toml.
    ///
    /// # Errors
    /// Files that cannot be written, or a list that cannot take the log any more.
    pub fn save(
        &self,
        plan: &Plan,
        counts_per_rev: f64,
        recorder: &Recorder,
    ) -> Result<(), Failure> {
        let entry = self.entry(plan);
        if !self.write_csv(&entry.file, recorder)? {
            return Ok(());
        }
        let appended = Dataset::append(&self.directory, &entry, counts_per_rev);
        self.print_log(&entry.file, if appended.is_ok() { "" } else { "; not in dataset.toml" });
        appended?;
        self.write_mcap(&entry.file, counts_per_rev, recorder)
    }

    /// Writes a log that is no experiment of the data set, for this reason: the approach, or a run
    /// to be fitted to that a fault has ended.
    ///
    /// # Errors
    /// Files that cannot be written.
    pub fn save_unlisted(
        &self,
        name: &str,
        why: &str,
        counts_per_rev: f64,
        recorder: &Recorder,
    ) -> Result<(), Failure> {
        let file = self.free_name(name) + CSV;
        if !self.write_csv(&file, recorder)? {
            return Ok(());
        }
        self.print_log(&file, &format!(", {why}; not in dataset.toml"));
        self.write_mcap(&file, counts_per_rev, recorder)
    }

    /// Writes the CSV log; false, with a line on the terminal, if there is nothing to write.
    fn write_csv(&self, file: &str, recorder: &Recorder) -> Result<bool, Failure> {
        if recorder.log.len() < 2 {
            try_print_line("log         none, nothing was recorded");
            return Ok(false);
        }
        recorder.log.write(self.directory.join(file))?;
        Ok(true)
    }

    /// Last, as the log is whole without it.
    fn write_mcap(
        &self,
        file: &str,
        counts_per_rev: f64,
        recorder: &Recorder,
    ) -> Result<(), Failure> {
        let mcap = self.directory.join(file.replace(CSV, MCAP));
        // It has just ended.
        let duration_ns = recorder.log.time_s.last().map_or(0, |last_s| (last_s * 1e9) as u64);
        let details = McapDetails {
            counts_per_rev: Some(counts_per_rev),
            began_unix_ns: unix_ns().saturating_sub(duration_ns),
            board: &recorder.board,
        };
        Ok(recorder.log.write_with(mcap, &details)?)
    }

    fn print_log(&self, file: &str, what: &str) {
        try_print_line(format_args!("log         {}{what}", self.directory.join(file).display()));
    }

    fn entry(&self, plan: &Plan) -> Entry {
        Entry { file: self.free_name(&plan.name) + CSV, ..plan.entry("") }
    }

    /// The name, or name-2, name-3: no log takes the place of another.
    fn free_name(&self, name: &str) -> String {
        let is_free = |name: &String| {
            [CSV, MCAP]
                .iter()
                .all(|ending| !self.directory.join(format!("{name}{ending}")).exists())
        };
        let numbered = (2..).map(|number| format!("{name}-{number}"));
        std::iter::once(name.to_owned()).chain(numbered).find(is_free).unwrap_or_default()
    }
}

const CSV: &str = ".csv.gz";
const MCAP: &str = ".mcap";
/// Ending of a log that was still being written.
const UNFINISHED: &str = ".unfinished.csv";

impl Drop for LogFolder {
    fn drop(&mut self) {
        // Only an empty directory can be removed so.
        self.made.iter().for_each(|path| drop(std::fs::remove_dir(path)));
    }
}
