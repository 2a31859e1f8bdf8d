//! Bars in rows and columns, each with its number.

use super::svg::{Anchor, GRID, picture, rectangle, text, vertical};

/// A row: a name and a bar per column.
#[derive(Clone, Debug, PartialEq)]
pub struct BarRow {
    /// What the row is.
    pub name: String,
    /// Lengths, one per column; those not finite are left out.
    pub values: Vec<f64>,
    /// The bars' colour, as SVG writes it.
    pub colour: &'static str,
}

/// A table whose cells are bars; columns of one unit are on one scale.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BarTable {
    /// The columns' names.
    pub columns: Vec<String>,
    /// The rows, first on top.
    pub rows: Vec<BarRow>,
    /// A value per column that a broken line marks.
    pub marks: Vec<f64>,
    /// What the numbers are in, one per column; those without one have none.
    pub units: Vec<String>,
}

/// Width of the picture [px].
pub const WIDTH: f64 = 1080.0;
const NAMES: f64 = 250.0;
const ROW: f64 = 26.0;
const TOP: f64 = 34.0;
/// The longest name that fits.
const LETTERS: usize = 34;
/// Room for the number after a bar.
const NUMBER: f64 = 78.0;

impl BarTable {
    /// The table as an SVG element.
    pub fn to_svg(&self) -> String {
        let height = self.height();
        let mut body = String::new();
        for (index, name) in self.columns.iter().enumerate() {
            let x = self.left(index);
            body += &text(x, 20.0, 14, Anchor::Start, name);
            body += &vertical(x, TOP - 4.0, height - 6.0, GRID, false);
        }
        for (index, row) in self.rows.iter().enumerate() {
            body += &self.row(row, TOP + ROW * index as f64);
        }
        for (index, &mark) in self.marks.iter().enumerate() {
            let x = self.left(index) + self.length(index, mark);
            body += &vertical(x, TOP - 4.0, height - 6.0, "#6e6e6e", true);
        }
        picture(WIDTH, height, &body)
    }

    /// Height of the picture [px].
    pub fn height(&self) -> f64 {
        TOP + ROW * self.rows.len() as f64 + 8.0
    }

    fn row(&self, row: &BarRow, y: f64) -> String {
        let mut body =
            text(NAMES - 12.0, y + 16.0, 13, Anchor::End, &shortened(&row.name, LETTERS));
        for (index, &value) in row.values.iter().enumerate().filter(|(_, v)| v.is_finite()) {
            let (x, length) = (self.left(index), self.length(index, value));
            let number = format!("{} {}", digits(value), self.unit(index));
            body += &rectangle(x, y + 3.0, length.max(1.0), ROW - 8.0, row.colour);
            body += &text(x + length + 6.0, y + 16.0, 12, Anchor::Start, &number);
        }
        body
    }

    fn left(&self, column: usize) -> f64 {
        NAMES + self.column_width() * column as f64
    }

    fn column_width(&self) -> f64 {
        (WIDTH - NAMES) / self.columns.len().max(1) as f64
    }

    fn unit(&self, column: usize) -> &str {
        self.units.get(column).map_or("", String::as_str)
    }

    fn length(&self, column: usize, value: f64) -> f64 {
        let alike = |(other, _): &(usize, f64)| self.unit(*other) == self.unit(column);
        let values = self.rows.iter().flat_map(|row| row.values.iter().copied().enumerate());
        let alike = values.filter(alike).map(|(_, value)| value);
        let most = alike.filter(|v| v.is_finite()).fold(f64::MIN_POSITIVE, f64::max);
        (value / most).clamp(0.0, 1.0) * (self.column_width() - NUMBER).max(10.0)
    }
}

/// Names of more letters than their column holds end in dots.
pub(super) fn shortened(name: &str, most: usize) -> String {
    if name.chars().count() <= most {
        return name.to_owned();
    }
    name.chars().take(most - 1).chain(['…']).collect()
}

fn digits(value: f64) -> String {
    if value < 10.0 {
        format!("{value:.2}")
    } else if value < 100.0 {
        format!("{value:.1}")
    } else {
        format!("{value:.0}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longest_bar_fits_and_a_bad_number_is_left_out() {
        let row = BarRow { name: "a<b".into(), values: vec![4.0, f64::NAN], colour: "#000" };
        let columns = vec!["joint 1".into(), "joint 2".into()];
        let table = BarTable { columns, rows: vec![row], ..BarTable::default() };
        let svg = table.to_svg();
        assert_eq!(svg.matches("<rect").count(), 1);
        assert!(svg.contains("a&lt;b") && !svg.contains("NaN"));
        assert!(table.left(0) + table.length(0, 4.0) < table.left(1));
    }

    #[test]
    fn columns_of_another_unit_have_their_own_scale() {
        let row = BarRow { name: "gap".into(), values: vec![400.0, 4.0, 2.0], colour: "#000" };
        let units = ["mA", "mN", "mN"].map(String::from).to_vec();
        let columns = vec![String::new(); 3];
        let table = BarTable { columns, rows: vec![row], units, ..BarTable::default() };
        let longest = table.length(0, 400.0);
        assert_eq!((table.length(1, 4.0), table.length(2, 2.0)), (longest, 0.5 * longest));
        assert!(table.to_svg().contains("4.00 mN"));
    }
}
