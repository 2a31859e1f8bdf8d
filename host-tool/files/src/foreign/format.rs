//! Which reader a file is for, by the ending of its name.

use std::path::Path;

use super::{Stream, Wanted, delimited, npz, parquet, rosbag2};
use crate::bytes;
use crate::error::{FileError, LocatedProblem, Problem};

#[derive(Clone, Copy)]
enum Format {
    Text,
    Npy,
    Npz,
    Parquet,
    Mcap,
}

impl Format {
    fn of(path: &Path) -> Option<Self> {
        let name = path.to_string_lossy().to_ascii_lowercase();
        let plain = name.strip_suffix(".gz").unwrap_or(&name);
        let (_, ending) = plain.rsplit_once('.')?;
        match ending {
            "csv" | "tsv" | "txt" => Some(Self::Text),
            _ if plain != name => None,
            "npy" => Some(Self::Npy),
            "npz" => Some(Self::Npz),
            "parquet" | "pq" => Some(Self::Parquet),
            "mcap" => Some(Self::Mcap),
            _ => None,
        }
    }
}

/// Whether a file's name ends in what is read here.
pub fn is_readable(path: &Path) -> bool {
    Format::of(path).is_some()
}

/// Reads a file's streams; columns that are not wanted keep their names alone.
///
/// # Errors
/// Names the file, what is wrong, and a remedy.
pub fn read(path: &Path, wanted: Wanted) -> Result<Vec<Stream>, FileError> {
    if Format::of(path).is_none() {
        return Err(Problem::UnknownTable.in_file(path));
    }
    of(path, &bytes::read(path)?, wanted)
}

/// The streams in the bytes of a file of that name.
///
/// # Errors
/// As of [`read`].
pub fn parse(path: &Path, bytes: Vec<u8>, wanted: Wanted) -> Result<Vec<Stream>, FileError> {
    of(path, &bytes::content(path, bytes)?, wanted)
}

fn of(path: &Path, content: &[u8], wanted: Wanted) -> Result<Vec<Stream>, FileError> {
    let single = |table| vec![Stream { name: String::new(), table }];
    let read = match Format::of(path) {
        Some(Format::Text) => delimited::read(content, wanted).map(single),
        Some(Format::Npy) => npz::read_one(content).map(single).map_err(LocatedProblem::from),
        Some(Format::Npz) => npz::read(content, wanted).map_err(LocatedProblem::from),
        Some(Format::Parquet) => {
            parquet::read(content, wanted).map(single).map_err(LocatedProblem::from)
        }
        Some(Format::Mcap) => rosbag2::read(content, wanted).map_err(LocatedProblem::from),
        None => Err(Problem::UnknownTable.into()),
    };
    read.map_err(|fault| fault.in_file(path))
}
