//! Shares as bars from 0 to 100 %, each with its interval.

use super::bar_table::{WIDTH, shortened};
use super::svg::{Anchor, GRID, INK, picture, rectangle, text, vertical};

/// A row: a name, and its share of a whole.
#[derive(Clone, Debug, PartialEq)]
pub struct ShareRow {
    /// What takes the share.
    pub name: String,
    /// Its share, 0 to 1.
    pub share: f64,
    /// The ends of the share's interval, where it has one.
    pub interval: Option<[f64; 2]>,
    /// What is written to the right.
    pub note: String,
    /// The bar's colour, as SVG writes it.
    pub colour: &'static str,
}

/// Rows of shares, one below the other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShareBars {
    /// The rows, first on top.
    pub rows: Vec<ShareRow>,
}

const NAMES: f64 = 330.0;
const BARS: f64 = 370.0;
const ROW: f64 = 30.0;
const TOP: f64 = 30.0;
/// Height of the marks at an interval's ends.
const END: f64 = 8.0;
/// The longest name that fits.
const LETTERS: usize = 46;

impl ShareBars {
    /// The picture as an SVG element.
    pub fn to_svg(&self) -> String {
        let height = TOP + ROW * self.rows.len() as f64 + 8.0;
        let mut body = String::new();
        for quarter in 0..=4 {
            let share = 0.25 * f64::from(quarter);
            let percent = format!("{:.0} %", 100.0 * share);
            body += &text(x_of(share), 18.0, 12, Anchor::Middle, &percent);
            body += &vertical(x_of(share), TOP - 6.0, height - 6.0, GRID, false);
        }
        for (index, row) in self.rows.iter().enumerate() {
            body += &drawn(row, TOP + ROW * index as f64);
        }
        picture(WIDTH, height, &body)
    }
}

fn x_of(share: f64) -> f64 {
    let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 };
    NAMES + BARS * share
}

fn drawn(row: &ShareRow, y: f64) -> String {
    let middle = y + 0.5 * (ROW - 8.0) + 2.0;
    let length = (x_of(row.share) - NAMES).max(1.0);
    let mut body =
        text(NAMES - 12.0, middle + 5.0, 14, Anchor::End, &shortened(&row.name, LETTERS));
    body += &rectangle(NAMES, y + 2.0, length, ROW - 8.0, row.colour);
    body += &row.interval.map_or_else(String::new, |interval| whisker(interval, middle));
    body + &text(NAMES + BARS + 22.0, middle + 5.0, 13, Anchor::Start, &row.note)
}

/// A line over an interval, with marks at its ends.
fn whisker(interval: [f64; 2], y: f64) -> String {
    let [low, high] = interval.map(x_of);
    let end = |x: f64| vertical(x, y - 0.5 * END, y + 0.5 * END, INK, false);
    rectangle(low, y - 0.6, (high - low).max(1.0), 1.2, INK) + &end(low) + &end(high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_stay_on_their_scale() {
        let row = |share: f64, interval| ShareRow {
            name: "a<b".into(),
            share,
            interval,
            note: String::new(),
            colour: "#000",
        };
        let rows = vec![row(0.5, Some([0.4, 1.7])), row(-0.2, None), row(f64::NAN, None)];
        let svg = ShareBars { rows }.to_svg();
        assert!(svg.contains("a&lt;b") && !svg.contains("NaN"), "{svg}");
        assert_eq!(svg.matches("<rect").count(), 4);
        assert!(svg.contains("width=\"185.0\""), "half of the scale: {svg}");
    }
}
