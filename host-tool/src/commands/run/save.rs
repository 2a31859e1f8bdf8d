//! The folder that runs are recorded into, a data set.

use std::path::{Path, PathBuf};

use firmware::ParameterBlock;

use crate::commands::{Failure, create_directory};
use crate::files::dataset::LIST_NAME;
use crate::files::{Dataset, Entry, Role};
use crate::link::Recorder;
use crate::simulation::Plan;

/// A data set that grows by one log a run.
#[derive(Debug)]
pub struct Folder {
    directory: PathBuf,
    dataset: Option<Dataset>,
}

impl Folder {
    /// The data set that is there, or will be; makes the directory.
    ///
    /// # Errors
    /// A dataset.toml that cannot be used, or a directory that cannot be made.
    pub fn open(directory: &Path) -> Result<Self, Failure> {
        create_directory(directory)?;
        let is_there = directory.join(LIST_NAME).exists();
        let dataset = is_there.then(|| Dataset::read(directory)).transpose()?;
        Ok(Self { directory: directory.to_owned(), dataset })
    }

    /// Writes a run's log as CSV and MCAP, and its line of dataset.toml.
    ///
    /// # Errors
    /// Files that cannot be written, or an encoder other than that of the logs there.
    pub fn save(
        &mut self,
        plan: &Plan,
        role: Option<Role>,
        block: &ParameterBlock,
        recorder: &Recorder,
    ) -> Result<(), Failure> {
        if recorder.log.len() < 2 {
            println!("nothing was recorded");
            return Ok(());
        }
        let name = self.free_name(&plan.name);
        let file = format!("{name}.csv.gz");
        recorder.log.write(self.directory.join(&file))?;
        let mcap = self.directory.join(format!("{name}.mcap"));
        recorder.log.write_with_board(mcap, &recorder.board)?;
        println!("log         {}", self.directory.join(&file).display());
        let entry = Entry { file, role: role.unwrap_or(plan.role), ..plan.entry("csv.gz") };
        self.add(entry, f64::from(block.encoder_counts_per_turn))
    }

    fn add(&mut self, entry: Entry, counts_per_rev: f64) -> Result<(), Failure> {
        let dataset = self.dataset.get_or_insert_with(|| Dataset {
            directory: self.directory.clone(),
            encoder_counts_per_rev: Some(counts_per_rev),
            entries: Vec::new(),
        });
        let there = *dataset.encoder_counts_per_rev.get_or_insert(counts_per_rev);
        if there != counts_per_rev {
            let list = self.directory.join(LIST_NAME);
            let message = format!(
                "{}: encoder_counts_per_rev is {there}, the board has {counts_per_rev}; \
                 the log {} is not in the list",
                list.display(),
                entry.file
            );
            return Err(Failure::new(message, "record into another directory"));
        }
        dataset.entries.push(entry);
        Ok(dataset.write(&self.directory)?)
    }

    /// The name, or name-2, name-3: no log takes the place of another.
    fn free_name(&self, name: &str) -> String {
        let is_free = |name: &str| {
            let path = |ending: &str| self.directory.join(format!("{name}{ending}"));
            [".csv.gz", ".mcap"].iter().all(|ending| !path(ending).exists())
        };
        let numbered = (2..).map(|number| format!("{name}-{number}"));
        std::iter::once(name.to_owned())
            .chain(numbered)
            .find(|name| is_free(name))
            .unwrap_or_else(|| name.to_owned())
    }
}
