//! One NumPy array: <https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html>.

use crate::error::Problem;
use crate::table::Values;

/// An array of numbers of one or two dimensions.
#[derive(Debug)]
pub(super) struct Array<'a> {
    pub(super) rows: usize,
    pub(super) columns: usize,
    /// Whether it has two dimensions.
    pub(super) is_matrix: bool,
    by_columns: bool,
    kind: Kind,
    data: &'a [u8],
}

#[derive(Clone, Copy, Debug)]
struct Kind {
    letter: u8,
    bytes: usize,
    is_big_endian: bool,
}

const MAGIC: &[u8] = b"\x93NUMPY";

impl<'a> Array<'a> {
    /// The array in a `.npy` file's bytes.
    pub(super) fn of(bytes: &'a [u8]) -> Result<Self, Problem> {
        let (header, data) = split(bytes).ok_or_else(|| damaged("it has no header of NumPy"))?;
        let kind = kind(header)?;
        let shape = shape(header).ok_or_else(|| damaged("its shape cannot be read"))?;
        let (rows, columns) = match shape.as_slice() {
            [rows] => (*rows, 1),
            [rows, columns] => (*rows, *columns),
            _ => return Err(damaged(&format!("it has {} dimensions, not 1 or 2", shape.len()))),
        };
        let length = rows.checked_mul(columns).and_then(|count| count.checked_mul(kind.bytes));
        if length.is_none_or(|length| length > data.len()) {
            return Err(damaged("it is cut short"));
        }
        let by_columns = header.contains("'fortran_order': True");
        Ok(Self { rows, columns, is_matrix: shape.len() == 2, by_columns, kind, data })
    }

    /// The array with rows and columns exchanged.
    pub(super) fn transposed(self) -> Self {
        Self { rows: self.columns, columns: self.rows, by_columns: !self.by_columns, ..self }
    }

    /// A column of it.
    pub(super) fn column(&self, column: usize) -> Values {
        let cells = (0..self.rows).map(|row| self.bytes_at(row, column));
        match self.kind.letter {
            b'f' => Values::Float(cells.map(|cell| self.kind.float(cell)).collect()),
            _ => Values::Count(cells.map(|cell| self.kind.whole(cell)).collect()),
        }
    }

    fn bytes_at(&self, row: usize, column: usize) -> &'a [u8] {
        let index = match self.by_columns {
            true => column * self.rows + row,
            false => row * self.columns + column,
        };
        let begin = index * self.kind.bytes;
        self.data.get(begin..begin + self.kind.bytes).unwrap_or_default()
    }
}

impl Kind {
    fn float(self, cell: &[u8]) -> f64 {
        let bits = self.bits(cell);
        match self.bytes {
            4 => f64::from(f32::from_bits(bits as u32)),
            _ => f64::from_bits(bits),
        }
    }

    fn whole(self, cell: &[u8]) -> i64 {
        let bits = self.bits(cell);
        let unused = 64 - 8 * self.bytes as u32;
        match self.letter {
            b'i' => ((bits << unused) as i64) >> unused,
            _ => i64::try_from(bits).unwrap_or(i64::MAX),
        }
    }

    fn bits(self, cell: &[u8]) -> u64 {
        let push = |bits: u64, byte: &u8| bits << 8 | u64::from(*byte);
        match self.is_big_endian {
            true => cell.iter().fold(0, push),
            false => cell.iter().rev().fold(0, push),
        }
    }
}

/// The header's text and the data behind it.
fn split(bytes: &[u8]) -> Option<(&str, &[u8])> {
    let rest = bytes.strip_prefix(MAGIC)?;
    let (&[major, _minor], rest) = rest.split_first_chunk::<2>()?;
    let (length, rest) = if major == 1 {
        let (length, rest) = rest.split_first_chunk::<2>()?;
        (usize::from(u16::from_le_bytes(*length)), rest)
    } else {
        let (length, rest) = rest.split_first_chunk::<4>()?;
        (u32::from_le_bytes(*length) as usize, rest)
    };
    let (header, data) = rest.split_at_checked(length)?;
    Some((std::str::from_utf8(header).ok()?, data))
}

/// What follows a key of the header's dictionary.
fn value<'a>(header: &'a str, key: &str) -> Option<&'a str> {
    let (_, rest) = header.split_once(&format!("'{key}':"))?;
    Some(rest.trim_start())
}

fn kind(header: &str) -> Result<Kind, Problem> {
    let text = value(header, "descr").and_then(|rest| rest.strip_prefix('\''));
    let text = text.and_then(|rest| rest.split_once('\'')).map(|(text, _)| text);
    let text = text.ok_or_else(|| damaged("its elements are not plain numbers"))?;
    let unknown = || damaged(&format!("its elements are of type {text}, not numbers"));
    let (order, rest) = text.split_at_checked(1).ok_or_else(unknown)?;
    let (letter, bytes) = rest.split_at_checked(1).ok_or_else(unknown)?;
    let (letter, bytes) = (letter.as_bytes()[0], bytes.parse().map_err(|_| unknown())?);
    match (letter, bytes) {
        (b'f', 4 | 8) | (b'i' | b'u', 1 | 2 | 4 | 8) | (b'b', 1) => {
            Ok(Kind { letter, bytes, is_big_endian: order == ">" })
        }
        _ => Err(unknown()),
    }
}

fn shape(header: &str) -> Option<Vec<usize>> {
    let (text, _) = value(header, "shape")?.strip_prefix('(')?.split_once(')')?;
    let sizes = text.split(',').map(str::trim).filter(|size| !size.is_empty());
    sizes.map(|size| size.parse().ok()).collect()
}

fn damaged(what: &str) -> Problem {
    Problem::Damaged { format: "NumPy", what: what.to_owned() }
}
