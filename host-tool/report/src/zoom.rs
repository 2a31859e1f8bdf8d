//! Charts that can be looked at piece by piece: the drawing's parts are marked, and a small script in the
//! page stretches the lines and draws the axes anew.

/// What the mark of the axes begins with; numbers follow.
pub(super) const FRAME: &str = "\u{ab}frame ";
/// The mark where lines begin.
pub(super) const SERIES: &str = "\u{ab}series";
/// The mark where they end.
pub(super) const SERIES_END: &str = "\u{ab}end";

/// The script of a page with such charts.
pub(super) const SCRIPT: &str = include_str!("zoom.js");

/// The drawing with its marks made groups that the script finds.
pub(super) fn zoomable(svg: &str) -> String {
    let Some((head, frame, rest)) = cut(svg, FRAME) else { return svg.to_owned() };
    let numbers = frame.trim_start_matches(FRAME).trim().to_owned();
    let Some((mesh, _, rest)) = cut(rest, SERIES) else { return svg.to_owned() };
    let Some((series, _, legend)) = cut(rest, SERIES_END) else { return svg.to_owned() };
    let head = match numbers.is_empty() {
        true => head.to_owned(),
        false => head.replacen("<svg ", &format!("<svg data-frame=\"{numbers}\" "), 1),
    };
    format!("{head}<g class=\"mesh\">{mesh}</g><g><g class=\"series\">{series}</g></g>{legend}")
}

/// The text before the element with a mark, the mark, and the text behind it.
fn cut<'a>(svg: &'a str, mark: &str) -> Option<(&'a str, &'a str, &'a str)> {
    let at = svg.find(mark)?;
    let begin = svg[..at].rfind("<text")?;
    let end = at + svg[at..].find("</text>")?;
    Some((&svg[..begin], svg[at..end].trim(), &svg[end + "</text>".len()..]))
}

#[cfg(test)]
mod tests {
    use crate::{Chart, Series};

    #[test]
    fn a_chart_tells_its_axes_and_holds_no_marks() {
        let svg =
            Chart::new("t", "x", "y").with(Series::line("a", 0, vec![(0.0, 1.0), (2.0, 3.0)]));
        let svg = svg.to_svg();
        assert!(!svg.contains('\u{ab}'), "{svg}");
        let frame = svg.split("data-frame=\"").nth(1).unwrap().split('"').next().unwrap();
        let numbers: Vec<f64> = frame.split(' ').map(|number| number.parse().unwrap()).collect();
        assert_eq!((numbers.len(), numbers[4], numbers[5]), (8, 0.0, 2.0));
        let (_, series) = svg.split_once("class=\"series\"").unwrap();
        assert!(series.split_once("</g>").unwrap().0.contains("<polyline"), "{svg}");
    }
}
