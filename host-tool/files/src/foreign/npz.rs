//! NumPy's archives: a `.npy` file for each array, in a ZIP file.

use std::collections::BTreeMap;
use std::io::{Cursor, Read};

use zip::ZipArchive;

use super::npy::Array;
use super::{Stream, Wanted};
use crate::error::Problem;
use crate::table::{Table, Values};

/// Columns that a matrix may have at most; images are wider.
const WIDEST: usize = 1024;
/// How much larger than packed an array can be: the format's own bound.
const GREATEST_RATIO: u64 = 1032;

/// The columns of a single array.
pub(super) fn read_one(bytes: &[u8]) -> Result<Table, Problem> {
    let array = Array::of(bytes)?;
    if array.columns > WIDEST {
        let what = format!("{} columns are more than {WIDEST}", array.columns);
        return Err(Problem::Damaged { format: "NumPy", what });
    }
    let columns = (0..array.columns).map(|index| (format!("column[{index}]"), array.column(index)));
    Table::of(columns.collect())
}

/// The archive's arrays; those of equal length are a stream.
pub(super) fn read(bytes: &[u8], wanted: Wanted) -> Result<Vec<Stream>, Problem> {
    let unpacked = unpack(bytes)?;
    let arrays = unpacked.iter().filter_map(|(name, bytes)| Some((name, Array::of(bytes).ok()?)));
    let arrays: Vec<(&String, Array)> = arrays.collect();
    let is_vector = |(_, array): &&(&String, Array)| !array.is_matrix;
    let lengths: Vec<usize> =
        arrays.iter().filter(is_vector).map(|(_, array)| array.rows).collect();
    let mut streams: BTreeMap<usize, Vec<(String, Values)>> = BTreeMap::new();
    for (name, array) in arrays {
        // A matrix with a row for each joint and a column for each sample.
        let lies = !lengths.contains(&array.rows) && lengths.contains(&array.columns);
        let array = if lies && array.is_matrix { array.transposed() } else { array };
        if array.columns <= WIDEST {
            streams.entry(array.rows).or_default().extend(columns(name, &array, wanted));
        }
    }
    if streams.is_empty() {
        let what = "no array of numbers is in it".to_owned();
        return Err(Problem::Damaged { format: "npz", what });
    }
    let alone = streams.len() == 1;
    let stream = |(rows, columns): (usize, Vec<(String, Values)>)| {
        let name = if alone { String::new() } else { format!("{rows} rows") };
        Ok(Stream { name, table: Table::of(columns)? })
    };
    streams.into_iter().map(stream).collect()
}

fn columns(name: &str, array: &Array, wanted: Wanted) -> Vec<(String, Values)> {
    let is_wanted = wanted(name);
    let column = |index: usize| if is_wanted { array.column(index) } else { Values::Skipped };
    match array.is_matrix {
        false => vec![(name.to_owned(), column(0))],
        true => {
            (0..array.columns).map(|index| (format!("{name}[{index}]"), column(index))).collect()
        }
    }
}

/// The files of the archive by their names without ending.
fn unpack(bytes: &[u8]) -> Result<Vec<(String, Vec<u8>)>, Problem> {
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| damaged(&error))?;
    let mut files = Vec::new();
    for index in 0..archive.len() {
        let file = archive.by_index(index).map_err(|error| damaged(&error))?;
        let name = file.name().map_err(|error| damaged(&error))?.into_owned();
        let Some(name) = name.strip_suffix(".npy").map(str::to_owned) else { continue };
        let mut content = Vec::new();
        let limit = (bytes.len() as u64).saturating_mul(GREATEST_RATIO);
        file.take(limit).read_to_end(&mut content).map_err(|error| damaged(&error))?;
        files.push((name, content));
    }
    Ok(files)
}

fn damaged(error: &dyn std::fmt::Display) -> Problem {
    Problem::Damaged { format: "npz", what: error.to_string() }
}
