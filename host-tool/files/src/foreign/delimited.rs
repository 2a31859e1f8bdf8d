//! Text in columns, however it is split: commas, semicolons (with decimal commas), tabs.
//!
//! The header may follow a `#` or `%`, and a line of units may follow it. What is no number reads as
//! none, for the mapping to leave out and to tell.

use super::Wanted;
use crate::bytes;
use crate::error::{LocatedProblem, Problem};
use crate::number;
use crate::table::{Table, Values};

/// Lines looked at for the first numbers.
const HEAD_LINES: usize = 40;

pub(super) fn read(text: &[u8], wanted: Wanted) -> Result<Table, LocatedProblem> {
    let text = bytes::check_text(text)?;
    let text = text.strip_prefix('\u{FEFF}').unwrap_or(text);
    let lines = || text.lines().filter(|line| !line.trim().is_empty());
    let separator = separator(lines());
    let head: Vec<&str> = lines().take(HEAD_LINES).collect();
    let Some(first) = head.iter().position(|line| is_numeric(line, separator)) else {
        return Err(if head.is_empty() { Problem::Empty } else { Problem::NoSamples }.into());
    };
    let names = names(&head[..first], head[first], separator);
    let mut columns: Vec<Column> = names.iter().map(|name| Column::new(wanted(name))).collect();
    for line in lines().skip(first) {
        let mut fields = line.split(separator);
        columns.iter_mut().for_each(|column| column.push(fields.next()));
    }
    let columns = names.into_iter().zip(columns.into_iter().map(Column::values));
    Table::of(columns.collect()).map_err(LocatedProblem::from)
}

/// What splits the fields: the first of semicolon, tab and comma that all of the first lines with
/// numbers could have.
fn separator<'a>(lines: impl Iterator<Item = &'a str>) -> char {
    let lines: Vec<&str> = lines.take(HEAD_LINES).collect();
    let splits = |separator: &char| lines.iter().any(|line| line.contains(*separator));
    [';', '\t', ','].into_iter().find(splits).unwrap_or(',')
}

/// Whether at least half of a line's fields are numbers.
fn is_numeric(line: &str, separator: char) -> bool {
    let numbers = line.split(separator).filter(|field| parse(field).is_some()).count();
    numbers > 0 && 2 * numbers >= line.split(separator).count()
}

/// The columns' names: the first line before the numbers that has as many fields as they.
fn names(head: &[&str], numbers: &str, separator: char) -> Vec<String> {
    let count = numbers.split(separator).count();
    let bare = |line: &&str| line.trim_start_matches(['#', '%', ' ']).to_owned();
    let header = head.iter().map(bare).find(|line| line.split(separator).count() == count);
    let mut names: Vec<String> = match header {
        Some(line) => line.split(separator).map(trimmed).collect(),
        None => (0..count).map(|index| format!("column[{index}]")).collect(),
    };
    for index in 1..names.len() {
        // A name that stands twice is told apart by its place.
        if names[..index].contains(&names[index]) {
            names[index] = format!("{}[{index}]", names[index]);
        }
    }
    names
}

fn trimmed(field: &str) -> String {
    String::from_utf8_lossy(number::trim(field.as_bytes())).into_owned()
}

/// A number, with a point or a comma.
fn parse(field: &str) -> Option<f64> {
    let bare = number::trim(field.as_bytes());
    let value = fast_float2::parse::<f64, _>(bare).ok().or_else(|| {
        let text = std::str::from_utf8(bare).ok()?;
        (text.matches(',').count() == 1).then(|| text.replace(',', ".").parse().ok()).flatten()
    });
    value.filter(|value| value.is_finite())
}

/// A column as it is read: whole numbers as long as there are no others.
struct Column {
    wanted: bool,
    whole: Option<Vec<i64>>,
    values: Vec<f64>,
}

impl Column {
    fn new(wanted: bool) -> Self {
        Self { wanted, whole: Some(Vec::new()), values: Vec::new() }
    }

    fn push(&mut self, field: Option<&str>) {
        if !self.wanted {
            return;
        }
        let field = field.unwrap_or_default();
        if let Some(whole) = &mut self.whole {
            match field.trim().parse() {
                Ok(value) => whole.push(value),
                Err(_) => self.whole = None,
            }
        }
        self.values.push(parse(field).unwrap_or(f64::NAN));
    }

    fn values(self) -> Values {
        match self.whole {
            _ if !self.wanted => Values::Skipped,
            Some(whole) => Values::Count(whole),
            None => Values::Float(self.values),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(text: &str) -> Table {
        read(text.as_bytes(), &|_| true).unwrap()
    }

    fn float(table: &mut Table, name: &str) -> Vec<f64> {
        table.take_float(name).unwrap()
    }

    #[test]
    fn semicolons_decimal_commas_and_a_line_of_units() {
        let mut table =
            table("Zeit;Winkel 1;Moment\r\ns;deg;Nm\r\n0,001;12,5;-1e-3\r\n0,002;;2\r\n");
        assert_eq!(table.names().collect::<Vec<_>>(), ["Zeit", "Winkel 1", "Moment"]);
        assert_eq!(float(&mut table, "Zeit"), [0.001, 0.002]);
        let angles = float(&mut table, "Winkel 1");
        assert!(angles[0] == 12.5 && angles[1].is_nan());
    }

    #[test]
    fn headers_behind_a_hash_tabs_and_whole_numbers() {
        let mut table = table("# recorded on rig 3\n# t\tq1\n1700000000000000001\t0.5\n");
        assert_eq!(table.take("t"), Some(Values::Count(vec![1_700_000_000_000_000_001])));
        assert_eq!(float(&mut table, "q1"), [0.5]);
    }

    #[test]
    fn without_a_header_columns_are_numbered() {
        assert_eq!(table("0,1.5\n1,2.5\n").names().collect::<Vec<_>>(), ["column[0]", "column[1]"]);
        let twice = table("t,q,q\n0,1.5,2\n");
        assert_eq!(twice.names().collect::<Vec<_>>(), ["t", "q", "q[2]"]);
    }
}
