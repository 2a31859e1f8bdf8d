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
    let numbers = frame.trim_start_matches(FRAME.trim_end()).trim().to_owned();
    let Some((mesh, _, rest)) = cut(rest, SERIES) else { return svg.to_owned() };
    let Some((series, _, legend)) = cut(rest, SERIES_END) else { return svg.to_owned() };
    let head = match numbers.is_empty() {
        true => head.to_owned(),
        false => head.replacen("<svg ", &format!("<svg data-frame=\"{numbers}\" "), 1),
    };
    format!("{head}<g class=\"mesh\">{mesh}</g><g><g class=\"series\">{series}</g></g>{legend}")
}

/// A line as it is drawn: colour, width [px], points.
pub(super) type Line = (String, u32, Vec<(f64, f64)>);

/// The drawing with its lines to a hundredth of a pixel, where the library draws whole pixels, of which a
/// closer look would show the steps.
pub(super) fn exact(svg: &str, lines: &[Line]) -> String {
    const OPEN: &str = "<g class=\"series\">";
    let Some(frame) = frame_of(svg) else { return svg.to_owned() };
    let Some((head, rest)) = svg.split_once(OPEN) else { return svg.to_owned() };
    let Some((_, tail)) = rest.split_once("</g>") else { return svg.to_owned() };
    let drawn: String = lines.iter().map(|line| polyline(line, frame)).collect();
    format!("{head}{OPEN}\n{drawn}</g>{tail}")
}

/// Pixels from left to right and from top to bottom, and what they span.
fn frame_of(svg: &str) -> Option<[f64; 8]> {
    let (_, rest) = svg.split_once("data-frame=\"")?;
    let numbers: Option<Vec<f64>> =
        rest.split('"').next()?.split(' ').map(|number| number.parse().ok()).collect();
    numbers?.try_into().ok()
}

fn polyline((colour, width, points): &Line, frame: [f64; 8]) -> String {
    let [left, right, top, bottom, x0, x1, y0, y1] = frame;
    let point = |(x, y): &(f64, f64)| {
        let across = left + (x - x0) / (x1 - x0) * (right - left);
        let down = bottom - (y - y0) / (y1 - y0) * (bottom - top);
        format!("{across:.2},{down:.2} ")
    };
    let points: String = points.iter().map(point).collect();
    format!(
        "<polyline fill=\"none\" opacity=\"1\" stroke=\"{colour}\" stroke-width=\"{width}\" \
         points=\"{points}\"/>\n"
    )
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
    use crate::{Axis, Chart, Series};

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

    /// The script stretches even axes alone.
    #[test]
    fn a_chart_of_decades_has_no_frame_to_zoom_by() {
        let line = Series::line("a", 0, vec![(1.0, 1.0), (100.0, 3.0)]);
        for axes in [(Axis::Logarithmic, Axis::Linear), (Axis::Logarithmic, Axis::Logarithmic)] {
            let svg = Chart::new("t", "x", "y").axes(axes.0, axes.1).with(line.clone()).to_svg();
            assert!(!svg.contains('\u{ab}') && !svg.contains("data-frame"), "{svg}");
            assert!(svg.contains("class=\"series\""), "{svg}");
        }
    }
}
