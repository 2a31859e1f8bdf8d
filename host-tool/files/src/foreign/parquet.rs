//! Parquet, as LeRobot, pandas and polars write it.

use bytes::Bytes;
use parquet::column::reader::get_column_reader;
use parquet::file::reader::{FileReader, SerializedFileReader};

use super::Wanted;
use super::guarded::guarded;
use super::parquet_column::{Cells, name, read_cells};
use super::parquet_pages::BoundedPages;
use super::parquet_schema::is_believable;
use crate::error::Problem;
use crate::table::{Table, Values};

/// Elements that a list may have at most; images are longer.
const LONGEST_LIST: usize = 1024;

/// The file's columns; lists of numbers have a column for each element.
pub(super) fn read(bytes: &[u8], wanted: Wanted) -> Result<Table, Problem> {
    if !is_believable(bytes) {
        let what = "its schema is no tree that the file could hold; write it again, with pyarrow or pandas";
        let what = what.to_owned();
        return Err(Problem::Damaged { format: "Parquet", what });
    }
    // The library takes much of a file on trust, and panics where that is betrayed.
    let read = guarded(|| columns(bytes, wanted));
    read.unwrap_or_else(|what| Err(Problem::Damaged { format: "Parquet", what }))
}

fn columns(bytes: &[u8], wanted: Wanted) -> Result<Table, Problem> {
    let reader = SerializedFileReader::new(Bytes::copy_from_slice(bytes)).map_err(damaged)?;
    let schema = reader.metadata().file_metadata().schema_descr_ptr();
    let mut columns = Vec::new();
    for (index, column) in schema.columns().iter().enumerate() {
        let name = name(column);
        if !wanted(&name) {
            columns.push((name, Values::Skipped));
            continue;
        }
        let Some(mut cells) = Cells::of(column) else { continue };
        for group in 0..reader.num_row_groups() {
            let group = reader.get_row_group(group).map_err(damaged)?;
            let pages = BoundedPages(group.get_column_page_reader(index).map_err(damaged)?);
            let reader = get_column_reader(column.clone(), Box::new(pages));
            read_cells(reader, &mut cells).map_err(damaged)?;
        }
        push(&mut columns, name, cells);
    }
    Table::of(columns)
}

fn push(columns: &mut Vec<(String, Values)>, name: String, cells: Cells) {
    if !cells.is_list {
        columns.push((name, cells.scalars()));
    } else if cells.longest() <= LONGEST_LIST {
        let element = |index| (format!("{name}[{index}]"), cells.elements(index));
        columns.extend((0..cells.longest()).map(element));
    }
}

fn damaged(error: parquet::errors::ParquetError) -> Problem {
    Problem::Damaged { format: "Parquet", what: error.to_string() }
}
