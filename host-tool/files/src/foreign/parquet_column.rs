//! A column of a Parquet file: numbers, or lists of numbers, with gaps where a value is absent.

use parquet::basic::{ConvertedType, LogicalType, TimeUnit, Type};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::DataType;
use parquet::errors::Result;
use parquet::schema::types::ColumnDescriptor;

use crate::table::Values;

/// Rows read at once.
const BATCH_ROWS: usize = 8192;

/// A column's name: its path in the schema, without what a list has of its own.
pub(super) fn name(column: &ColumnDescriptor) -> String {
    let mut parts = column.path().parts();
    if let [before @ .., list, _element] = parts
        && column.max_rep_level() == 1
        && matches!(list.as_str(), "list" | "bag" | "array")
        && !before.is_empty()
    {
        parts = before;
    }
    parts.join(".")
}

/// What was read of a column.
pub(super) struct Cells {
    pub(super) is_list: bool,
    /// Nanoseconds in a whole number, of a time stamp.
    ns_per_unit: i64,
    max_definition: i16,
    values: Vec<Number>,
    /// Where each row begins among the values.
    rows: Vec<usize>,
}

#[derive(Clone, Copy)]
enum Number {
    Absent,
    Whole(i64),
    Float(f64),
}

impl Cells {
    /// An empty one; `None` where the column holds no numbers, or lists of lists.
    pub(super) fn of(column: &ColumnDescriptor) -> Option<Self> {
        let is_number = match column.physical_type() {
            Type::BOOLEAN | Type::INT32 | Type::INT64 | Type::FLOAT | Type::DOUBLE => true,
            Type::INT96 | Type::BYTE_ARRAY | Type::FIXED_LEN_BYTE_ARRAY => false,
        };
        (is_number && column.max_rep_level() <= 1).then(|| Self {
            is_list: column.max_rep_level() == 1,
            ns_per_unit: ns_per_unit(column),
            max_definition: column.max_def_level(),
            values: Vec::new(),
            rows: Vec::new(),
        })
    }

    /// The one number of each row.
    pub(super) fn scalars(&self) -> Values {
        self.elements(0)
    }

    /// How many elements the longest list has.
    pub(super) fn longest(&self) -> usize {
        (0..self.rows.len()).map(|row| self.row(row).len()).max().unwrap_or(0)
    }

    /// An element of each row's list: whole numbers where all are there and whole.
    pub(super) fn elements(&self, index: usize) -> Values {
        let cells = || (0..self.rows.len()).map(|row| self.row(row).get(index).copied());
        let whole = cells().map(|cell| match cell {
            Some(Number::Whole(whole)) => whole.checked_mul(self.ns_per_unit),
            _ => None,
        });
        let float = |cell| match cell {
            Some(Number::Whole(whole)) => whole as f64 * self.ns_per_unit as f64,
            Some(Number::Float(float)) => float,
            _ => f64::NAN,
        };
        whole
            .collect::<Option<_>>()
            .map_or_else(|| Values::Float(cells().map(float).collect()), Values::Count)
    }

    fn row(&self, row: usize) -> &[Number] {
        let begin = self.rows[row];
        let end = self.rows.get(row + 1).copied().unwrap_or(self.values.len());
        &self.values[begin..end]
    }

    /// Takes in what a batch holds: levels say where rows begin and which values are absent.
    fn push(
        &mut self,
        definition: &[i16],
        repetition: &[i16],
        records: usize,
        values: Vec<Number>,
    ) {
        let mut values = values.into_iter();
        let levels =
            if definition.is_empty() { values.len().max(records) } else { definition.len() };
        for level in 0..levels {
            if !self.is_list || repetition.get(level).is_none_or(|&level| level == 0) {
                self.rows.push(self.values.len());
            }
            let is_there = definition.get(level).is_none_or(|&level| level == self.max_definition);
            let value = if is_there { values.next() } else { None };
            self.values.push(value.unwrap_or(Number::Absent));
        }
    }
}

/// Time stamps come in nanoseconds, whatever they are kept in.
fn ns_per_unit(column: &ColumnDescriptor) -> i64 {
    match (column.logical_type_ref(), column.converted_type()) {
        (Some(LogicalType::Timestamp(time)), _) => match time.unit {
            TimeUnit::MILLIS => 1_000_000,
            TimeUnit::MICROS => 1_000,
            TimeUnit::NANOS => 1,
        },
        (None, ConvertedType::TIMESTAMP_MILLIS) => 1_000_000,
        (None, ConvertedType::TIMESTAMP_MICROS) => 1_000,
        _ => 1,
    }
}

/// Reads all of a column in a group of rows.
pub(super) fn read_cells(reader: ColumnReader, cells: &mut Cells) -> Result<()> {
    match reader {
        ColumnReader::BoolColumnReader(reader) => {
            all(reader, cells, |bool| whole(i64::from(*bool)))
        }
        ColumnReader::Int32ColumnReader(reader) => {
            all(reader, cells, |value| whole((*value).into()))
        }
        ColumnReader::Int64ColumnReader(reader) => all(reader, cells, |value| whole(*value)),
        ColumnReader::FloatColumnReader(reader) => {
            all(reader, cells, |value| Number::Float(f64::from(*value)))
        }
        ColumnReader::DoubleColumnReader(reader) => {
            all(reader, cells, |value| Number::Float(*value))
        }
        _ => Ok(()),
    }
}

fn whole(value: i64) -> Number {
    Number::Whole(value)
}

fn all<T: DataType>(
    mut reader: ColumnReaderImpl<T>,
    cells: &mut Cells,
    number: impl Fn(&T::T) -> Number,
) -> Result<()> {
    loop {
        let (mut values, mut definition, mut repetition) = (Vec::new(), Vec::new(), Vec::new());
        let (records, _, _) = reader.read_records(
            BATCH_ROWS,
            Some(&mut definition),
            Some(&mut repetition),
            &mut values,
        )?;
        if records == 0 {
            return Ok(());
        }
        cells.push(&definition, &repetition, records, values.iter().map(&number).collect());
    }
}
