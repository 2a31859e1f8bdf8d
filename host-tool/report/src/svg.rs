//! Pieces of SVG that are written by hand.

use super::page::escape;

/// Colour of letters.
pub(super) const INK: &str = "#282c34";
/// Colour of lines behind the data.
pub(super) const GRID: &str = "#e2e5e9";

/// Where a text is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// A text whose line stands at y.
pub(super) fn text(x: f64, y: f64, size_px: u32, anchor: Anchor, text: &str) -> String {
    let anchor = match anchor {
        Anchor::Start => "start",
        Anchor::Middle => "middle",
        Anchor::End => "end",
    };
    let words = escape(text);
    format!(
        "<text x=\"{x:.1}\" y=\"{y:.1}\" font-family=\"sans-serif\" font-size=\"{size_px}\" \
         fill=\"{INK}\" text-anchor=\"{anchor}\">{words}</text>\n"
    )
}

/// A text that reads upwards along a vertical axis.
pub(super) fn upright(x: f64, y: f64, size_px: u32, words: &str) -> String {
    let words = escape(words);
    format!(
        "<text transform=\"translate({x:.1},{y:.1}) rotate(-90)\" font-family=\"sans-serif\" \
         font-size=\"{size_px}\" fill=\"{INK}\" text-anchor=\"middle\">{words}</text>\n"
    )
}

/// A filled rectangle.
pub(super) fn rectangle(x: f64, y: f64, width: f64, height: f64, fill: &str) -> String {
    format!(
        "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" \
         fill=\"{fill}\"/>\n"
    )
}

/// A vertical line.
pub(super) fn vertical(x: f64, from_y: f64, to_y: f64, colour: &str, dashed: bool) -> String {
    let dashes = if dashed { " stroke-dasharray=\"4 3\"" } else { "" };
    format!(
        "<line x1=\"{x:.1}\" x2=\"{x:.1}\" y1=\"{from_y:.1}\" y2=\"{to_y:.1}\" \
         stroke=\"{colour}\"{dashes}/>\n"
    )
}

/// The whole picture.
pub(super) fn picture(width: f64, height: f64, body: &str) -> String {
    format!(
        "<svg width=\"{width:.0}\" height=\"{height:.0}\" viewBox=\"0 0 {width:.0} {height:.0}\" \
         xmlns=\"http://www.w3.org/2000/svg\">\n{body}</svg>"
    )
}

/// A picture as a part of another, its upper left corner at x and y.
pub(super) fn placed(x: f64, y: f64, svg: &str) -> String {
    svg.replacen("<svg ", &format!("<svg x=\"{x:.0}\" y=\"{y:.0}\" "), 1) + "\n"
}

/// Round values between two, about `count` of them.
pub(super) fn ticks(lowest: f64, highest: f64, count: f64) -> Vec<f64> {
    let span = highest - lowest;
    if !(span.is_finite() && span > 0.0) {
        return Vec::new();
    }
    let decade = 10f64.powf((span / count).log10().floor());
    let fits = |step: &&f64| span / (*step * decade) <= count;
    let step = decade * [1.0, 2.0, 5.0, 10.0].iter().find(fits).copied().unwrap_or(10.0);
    let (first, last) = ((lowest / step).ceil() as i64, (highest / step).floor() as i64);
    (first..=last).map(|k| k as f64 * step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round() {
        assert_eq!(ticks(-0.9, 1.1, 5.0), [-0.5, 0.0, 0.5, 1.0]);
        assert!(ticks(1.0, 1.0, 5.0).is_empty());
    }
}
