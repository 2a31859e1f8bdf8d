//! A data set: a directory of logs that `dataset.toml` lists.

use std::io::Write;
use std::path::{Path, PathBuf};

use model::parameter::named;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::error::{FileError, Problem};
use super::known_keys::{self, TableKeys};
use super::log::Log;
use super::mapping::{self, Mapping, View};
use super::replace::replace_file;
use super::robot_file::whole_if_possible;
use super::toml_source::{FORMAT, TomlSource};

/// The name of the list in a data set's directory.
pub const LIST_NAME: &str = "dataset.toml";

/// The keys of the list; those of `[columns]` and `[streams]` are checked with the mapping.
const KEYS: [TableKeys; 2] = [
    ("", &["format", "encoder_counts_per_rev", "joints", "columns", "streams", "log"]),
    (
        "log",
        &[
            "file",
            "experiment",
            "role",
            "simulated",
            "joint",
            "joints",
            "columns",
            "streams",
            "files",
            "rows",
        ],
    ),
];

/// A list of logs in a directory.
#[derive(Clone, Debug, PartialEq)]
pub struct Dataset {
    /// Where the logs lie.
    pub directory: PathBuf,
    /// Encoder counts per turn, needed when a log is in counts.
    pub encoder_counts_per_rev: Option<f64>,
    /// The logs, in the order of the file.
    pub entries: Vec<Entry>,
}

/// One `[[log]]` of a data set.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// File name, relative to the data set's directory.
    pub file: String,
    /// What was done while recording.
    pub experiment: Experiment,
    /// What the log is for.
    pub role: Role,
    /// The joint, 1 to 3, of an experiment on one joint.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint: Option<u8>,
}

/// What was done while a log was recorded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Experiment {
    /// Legs at constant speed, both ways, the other joints held.
    ConstantVelocity,
    /// Open loop on one joint, slow and fast phases.
    FrictionExcitation,
    /// Open-loop noise on one joint below static friction.
    PreslidingNoise,
    /// Fourier series on all joints.
    Excitation,
    /// Slow reversals.
    Slow,
    /// Closed-loop motion with noise added to the command.
    DrivenNoise,
    /// Any other motion; unknown names are read as this.
    #[serde(other)]
    Task,
}

/// What a log is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Role {
    /// Parameters are fitted to it.
    Train,
    /// Models are judged on it.
    Holdout,
}

/// A log of a data set together with its entry.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// The entry in the list.
    pub entry: Entry,
    /// The log itself.
    pub log: Log,
    /// What was done to a log of a foreign file that its user should know.
    pub notes: Vec<String>,
    /// Encoder counts per turn; `None` only where the log is in radians.
    encoder_counts_per_rev: Option<f64>,
}

/// The text of `dataset.toml`.
#[derive(Serialize, Deserialize)]
struct List {
    format: i64,
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        serialize_with = "whole_if_possible"
    )]
    encoder_counts_per_rev: Option<f64>,
    #[serde(default, rename = "log")]
    logs: Vec<Entry>,
}

impl Dataset {
    /// Reads the list of a data set's directory, or of its `dataset.toml`, but none of its logs.
    ///
    /// # Errors
    /// Names the file and line, what is wrong, and a remedy.
    pub fn read(place: impl AsRef<Path>) -> Result<Self, FileError> {
        let directory = match place.as_ref() {
            list if list.ends_with(LIST_NAME) && list.is_file() => list.parent().unwrap_or(list),
            directory => directory,
        };
        Self::of(directory, &TomlSource::read(&directory.join(LIST_NAME))?)
    }

    /// The same from the list's bytes.
    ///
    /// # Errors
    /// As of [`Dataset::read`].
    pub fn parse(directory: impl AsRef<Path>, bytes: Vec<u8>) -> Result<Self, FileError> {
        let directory = directory.as_ref();
        Self::of(directory, &TomlSource::of(&directory.join(LIST_NAME), bytes)?)
    }

    fn of(directory: &Path, source: &TomlSource) -> Result<Self, FileError> {
        known_keys::check(source, &KEYS)?;
        let list: List = source.parse()?;
        check(&list, source)?;
        mapping::parse(source)?;
        Ok(Self {
            directory: directory.to_owned(),
            encoder_counts_per_rev: list.encoder_counts_per_rev,
            entries: list.logs,
        })
    }

    /// Writes the list, whole or not at all, into a directory that is there.
    ///
    /// # Errors
    /// The path cannot be written.
    pub fn write(&self, directory: impl AsRef<Path>) -> Result<(), FileError> {
        let path = directory.as_ref().join(LIST_NAME);
        let text = self.text(&path)?;
        replace_file(&path, |out| out.write_all(text.as_bytes()).map_err(Problem::Unwritable))
    }

    /// The list's text; the path is for messages.
    pub(super) fn text(&self, path: &Path) -> Result<String, FileError> {
        let list = List {
            format: FORMAT,
            encoder_counts_per_rev: self.encoder_counts_per_rev,
            logs: self.entries.clone(),
        };
        toml::to_string(&list).map_err(|e| Problem::Toml(e.to_string()).in_file(path))
    }

    /// Reads all logs, in the order of the list, on as many threads as there are cores.
    ///
    /// # Errors
    /// The first log in the list's order that cannot be used.
    pub fn recordings(&self) -> Result<Vec<Recording>, FileError> {
        self.recordings_where(|_| true)
    }

    /// Reads the logs of one role.
    ///
    /// # Errors
    /// The first log in the list's order that cannot be used.
    pub fn recordings_of(&self, role: Role) -> Result<Vec<Recording>, FileError> {
        self.recordings_where(|entry| entry.role == role)
    }

    /// Reads the logs whose entry the caller wants.
    ///
    /// # Errors
    /// The first log in the list's order that cannot be used.
    pub fn recordings_where(
        &self,
        wanted: impl Fn(&Entry) -> bool,
    ) -> Result<Vec<Recording>, FileError> {
        let places: Vec<usize> =
            (0..self.entries.len()).filter(|&place| wanted(&self.entries[place])).collect();
        let mapping = self.mapping()?;
        let read = places.into_par_iter().map(|place| self.recording(place, &mapping.view(place)));
        let read: Vec<_> = read.collect();
        read.into_iter().collect()
    }

    /// Which columns of foreign files the logs are made of, as the list in the directory says; nothing
    /// where there is no list, or one of other logs.
    ///
    /// # Errors
    /// A list that cannot be used.
    pub fn mapping(&self) -> Result<Mapping, FileError> {
        let path = self.directory.join(LIST_NAME);
        if !path.exists() {
            return Ok(Mapping::default());
        }
        let mapping = mapping::parse(&TomlSource::read(&path)?)?;
        Ok(if mapping.logs.len() == self.entries.len() { mapping } else { Mapping::default() })
    }

    /// Reads the log of that place in the list.
    fn recording(&self, place: usize, view: &View) -> Result<Recording, FileError> {
        let entry = &self.entries[place];
        let path = self.directory.join(&entry.file);
        let (log, notes) = Log::read_mapped(&self.directory, &entry.file, view)?;
        if let Some(joint) = entry.joint
            && log.joint(joint).is_none()
        {
            let what = format!("joint {joint}, which {LIST_NAME} names, is not in the log");
            return Err(Problem::Contradiction(what).in_file(&path));
        }
        if log.needs_counts_per_rev() && self.encoder_counts_per_rev.is_none() {
            let what = format!("encoder_counts_per_rev, which {} needs,", entry.file);
            return Err(Problem::MissingParameter(what).in_file(&self.directory.join(LIST_NAME)));
        }
        let encoder_counts_per_rev = self.encoder_counts_per_rev;
        let entry = Entry { file: view.label(&entry.file), ..entry.clone() };
        Ok(Recording { entry, log, notes, encoder_counts_per_rev })
    }
}

impl Recording {
    /// Encoder counts per turn; not a number where the log is in radians and none are given.
    pub fn counts_per_rev(&self) -> f64 {
        // Reading made sure of them where they matter.
        self.encoder_counts_per_rev.unwrap_or(f64::NAN)
    }

    /// The position of a joint, 1 to 3, in radians; `None` where the log lacks the joint.
    pub fn position_rad(&self, joint: u8) -> Option<Vec<f64>> {
        Some(self.log.joint(joint)?.position_rad(self.counts_per_rev()))
    }
}

fn check(list: &List, source: &TomlSource) -> Result<(), FileError> {
    if let Some(counts) = list.encoder_counts_per_rev
        && counts <= 0.0
    {
        let error = named("encoder_counts_per_rev", counts).error("be above 0");
        return Err(source.problem_in(error.into(), "encoder_counts_per_rev", None, ""));
    }
    for (index, entry) in list.logs.iter().enumerate() {
        if let Some(joint) = entry.joint
            && !(1..=3).contains(&joint)
        {
            let what = format!("joint of {} is {joint}, but must be 1, 2 or 3", entry.file);
            return Err(source.problem_in_nth(Problem::Contradiction(what), "log", index));
        }
    }
    if list.logs.is_empty() {
        return Err(source.problem(Problem::MissingParameter("[[log]]".to_owned())));
    }
    Ok(())
}
