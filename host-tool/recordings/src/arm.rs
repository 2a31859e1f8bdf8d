//! The recorded motions of an arm of any kind.

use files::{ArmFile, ArmLog, Dataset, Entry, FileError, Role};

/// An arm and its logs.
#[derive(Clone, Debug, PartialEq)]
pub struct ArmCampaign {
    /// What is known of the arm.
    pub arm: ArmFile,
    /// The logs, in the order of `dataset.toml`.
    pub recordings: Vec<ArmRecording>,
}

/// A log with its place in the data set.
#[derive(Clone, Debug, PartialEq)]
pub struct ArmRecording {
    /// File name, for messages.
    pub file: String,
    /// What the log is for.
    pub role: Role,
    /// The log, in the units of joints and drives.
    pub log: ArmLog,
}

impl ArmCampaign {
    /// Reads all logs of a data set.
    ///
    /// # Errors
    /// The first log in the list's order that cannot be used; names file, line and column.
    pub fn read(dataset: &Dataset, arm: ArmFile) -> Result<Self, FileError> {
        let read = |entry: &Entry| {
            let log = ArmLog::read(dataset.directory.join(&entry.file), &arm)?;
            Ok(ArmRecording { file: entry.file.clone(), role: entry.role, log })
        };
        let recordings = dataset.entries.iter().map(read).collect::<Result<_, FileError>>()?;
        Ok(Self { arm, recordings })
    }

    /// The logs of a role.
    pub fn of_role(&self, role: Role) -> impl Iterator<Item = &ArmRecording> {
        self.recordings.iter().filter(move |recording| recording.role == role)
    }
}
