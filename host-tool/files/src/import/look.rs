//! The files below a path, and what their streams look like.

use std::path::{Path, PathBuf};

use crate::error::{FileError, Problem};
use crate::foreign;
use crate::guess::{Looked, look};
use crate::table::{Table, Values};

/// Folders below the path that are looked into.
const DEEPEST: usize = 4;
/// Files that are looked at; more would take minutes.
const MOST_FILES: usize = 500;
/// Columns that tell an episode from the next in one file.
const EPISODES: [&str; 4] = ["episode_index", "episode", "trial", "run"];
/// Episodes of one file that get a log each.
const MOST_EPISODES: usize = 100;

/// A file that was looked at.
#[derive(Clone, Debug)]
pub(super) struct File {
    pub(super) path: PathBuf,
    pub(super) streams: Vec<StreamLook>,
    /// Column and values by which its rows fall into episodes.
    pub(super) episodes: Option<(String, Vec<i64>)>,
}

/// A stream that was looked at.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct StreamLook {
    pub(super) name: String,
    pub(super) columns: Vec<Looked>,
}

impl File {
    fn of(path: PathBuf) -> Result<Self, FileError> {
        let streams = foreign::read(&path, &|_| true)?;
        let episodes = streams.iter().find_map(|stream| episodes(&stream.table));
        let streams = streams.into_iter().map(|stream| StreamLook {
            columns: look(&stream.name, &stream.table),
            name: stream.name,
        });
        Ok(Self { path, streams: streams.collect(), episodes })
    }

    /// The names of its columns: files of the same are logs of the same kind.
    pub(super) fn shape(&self) -> Vec<(String, Vec<String>)> {
        let names = |stream: &StreamLook| stream.columns.iter().map(|c| c.name.clone()).collect();
        self.streams.iter().map(|stream| (stream.name.clone(), names(stream))).collect()
    }
}

/// The files that can be read, at or below a path, with what was said of those that cannot.
pub(super) fn files(path: &Path) -> Result<(Vec<File>, Vec<String>), FileError> {
    let mut paths = Vec::new();
    collect(path, DEEPEST, &mut paths)?;
    paths.sort();
    if path.is_file() {
        return Ok((vec![File::of(path.to_owned())?], Vec::new()));
    }
    let (mut files, mut said) = (Vec::new(), Vec::new());
    if paths.len() > MOST_FILES {
        said.push(format!("{} files; the first {MOST_FILES} were looked at", paths.len()));
    }
    for path in paths.into_iter().take(MOST_FILES) {
        match File::of(path) {
            Ok(file) => files.push(file),
            Err(error) => said.push(error.to_string()),
        }
    }
    match files.is_empty() {
        true => Err(Problem::NoTables(said.join("\n")).in_file(path)),
        false => Ok((files, said)),
    }
}

fn collect(path: &Path, deepest: usize, found: &mut Vec<PathBuf>) -> Result<(), FileError> {
    if !path.is_dir() {
        return match path.exists() {
            true => Ok(()),
            false => Err(Problem::Missing.in_file(path)),
        };
    }
    let entries =
        std::fs::read_dir(path).map_err(|error| Problem::Unreadable(error).in_file(path))?;
    for entry in entries.flatten() {
        let path = entry.path();
        if path.is_dir() && deepest > 0 {
            collect(&path, deepest - 1, found)?;
        } else if path.is_file() && foreign::is_readable(&path) {
            found.push(path);
        }
    }
    Ok(())
}

/// The column that tells episodes apart, where there are several.
fn episodes(table: &Table) -> Option<(String, Vec<i64>)> {
    let name = EPISODES.into_iter().find(|name| table.get(name).is_some())?;
    let Some(Values::Count(whole)) = table.get(name) else { return None };
    let mut values = whole.clone();
    values.sort_unstable();
    values.dedup();
    (2..=MOST_EPISODES).contains(&values.len()).then(|| (name.to_owned(), values))
}
