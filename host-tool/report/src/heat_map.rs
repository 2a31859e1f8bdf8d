//! A map in colours: blue below zero, white at zero, red above.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::axis::short;
use super::svg::{Anchor, GRID, INK, picture, rectangle, text, ticks, upright, vertical};

/// Values over a grid of two axes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HeatMap {
    /// Title above it.
    pub title: String,
    /// Below it, with unit.
    pub x_label: String,
    /// Beside it, with unit.
    pub y_label: String,
    /// Beside the colours, with unit.
    pub value_label: String,
    /// Lowest and highest x.
    pub x_range: (f64, f64),
    /// Lowest and highest y.
    pub y_range: (f64, f64),
    /// Cells, rows of equal length from the lowest y; NaN where there are no data.
    pub cells: Vec<Vec<f64>>,
    /// Value of the strongest colour, both ways.
    pub limit: f64,
}

const WIDTH: f64 = 535.0;
const HEIGHT: f64 = 270.0;
const LEFT: f64 = 58.0;
const RIGHT: f64 = 78.0;
const TOP: f64 = 32.0;
const BOTTOM: f64 = 42.0;
/// Colour where there are no data.
const NO_DATA: &str = "#e8eaed";
/// Colours to either side of white.
const SHADES: i32 = 12;

impl HeatMap {
    /// The map as an SVG element.
    pub fn to_svg(&self) -> String {
        let (width, height) = (WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM);
        let mut body = text(LEFT + width / 2.0, 18.0, 15, Anchor::Middle, &self.title);
        body += &rectangle(LEFT, TOP, width, height, NO_DATA);
        body += &self.patches(width, height);
        for x in ticks(self.x_range.0, self.x_range.1, 8.0) {
            let at = LEFT + width * part(x, self.x_range);
            body += &vertical(at, TOP + height, TOP + height + 4.0, INK, false);
            body += &text(at, TOP + height + 16.0, 12, Anchor::Middle, &short(x));
        }
        for y in ticks(self.y_range.0, self.y_range.1, 6.0) {
            let at = TOP + height * (1.0 - part(y, self.y_range));
            body += &text(LEFT - 6.0, at + 4.0, 12, Anchor::End, &short(y));
        }
        body += &text(LEFT + width / 2.0, HEIGHT - 8.0, 12, Anchor::Middle, &self.x_label);
        body += &upright(14.0, TOP + height / 2.0, 12, &self.y_label);
        body += &self.key(LEFT + width + 12.0, height);
        picture(WIDTH, HEIGHT, &body)
    }

    /// One path per shade keeps the page small.
    fn patches(&self, width: f64, height: f64) -> String {
        let mut paths: BTreeMap<i32, String> = BTreeMap::new();
        let high = height / self.cells.len().max(1) as f64;
        for (row, cells) in self.cells.iter().enumerate() {
            let wide = width / cells.len().max(1) as f64;
            let y = TOP + height - high * (row + 1) as f64;
            for (column, value) in cells.iter().enumerate().filter(|(_, v)| v.is_finite()) {
                let path = paths.entry(self.shade(*value)).or_default();
                let x = LEFT + wide * column as f64;
                let _ = write!(path, "M{x:.1} {y:.1}h{wide:.2}v{high:.2}h-{wide:.2}z");
            }
        }
        let path = |(shade, path): (&i32, &String)| {
            format!("<path fill=\"{}\" d=\"{path}\"/>\n", colour(*shade))
        };
        paths.iter().map(path).collect()
    }

    fn shade(&self, value: f64) -> i32 {
        let relative = (value / self.limit.max(f64::MIN_POSITIVE)).clamp(-1.0, 1.0);
        (relative * f64::from(SHADES)).round() as i32
    }

    /// The colours and what they mean.
    fn key(&self, x: f64, height: f64) -> String {
        let step = height / f64::from(2 * SHADES + 1);
        let mut body = rectangle(x - 0.5, TOP - 0.5, 13.0, height + 1.0, GRID);
        for shade in -SHADES..=SHADES {
            let y = TOP + step * f64::from(SHADES - shade);
            body += &rectangle(x, y, 12.0, step + 0.3, &colour(shade));
        }
        for (part, value) in [(0.0, self.limit), (0.5, 0.0), (1.0, -self.limit)] {
            let y = TOP + height * part + 4.0;
            body += &text(x + 17.0, y, 12, Anchor::Start, &short(round(value)));
        }
        body + &upright(WIDTH - 6.0, TOP + height / 2.0, 12, &self.value_label)
    }
}

fn part(value: f64, range: (f64, f64)) -> f64 {
    (value - range.0) / (range.1 - range.0)
}

/// Two digits.
fn round(value: f64) -> f64 {
    if value == 0.0 {
        return 0.0;
    }
    let scale = 10f64.powf(1.0 - value.abs().log10().floor());
    (value * scale).round() / scale
}

fn colour(shade: i32) -> String {
    const BLUE: [f64; 3] = [0.0, 90.0, 160.0];
    const RED: [f64; 3] = [200.0, 70.0, 0.0];
    let end = if shade < 0 { BLUE } else { RED };
    let strength = f64::from(shade.abs()) / f64::from(SHADES);
    let [r, g, b] = end.map(|end| (255.0 + strength * (end - 255.0)).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn empty_cells_stay_empty() {
        let cells = vec![vec![1.0, f64::NAN], vec![-1.0, 0.0]];
        let map = HeatMap {
            x_range: (0.0, 1.0),
            y_range: (-1.0, 1.0),
            cells,
            limit: 1.0,
            ..HeatMap::default()
        };
        let svg = map.to_svg();
        assert_eq!(svg.matches("<path").count(), 3);
        assert!(!svg.contains("NaN") && svg.contains("#c84600") && svg.contains("#005aa0"));
    }
}
