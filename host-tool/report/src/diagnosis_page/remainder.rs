//! What no cause explains, entry by entry: its curve with the band of its doubt.

use crate::{Chart, Series, Stroke};
use diagnosis::report::remaining_words::place_words;
use diagnosis::report::words::{axis_words, capitalised};
use diagnosis::{Axis, Remainder};

use super::over_axis::HALF;
use super::tables::percent_words;
use super::units::unit;

/// What the charts show.
pub(super) const CAPTION: &str = "Mean of what the model with its causes leaves, with the band of \
    two standard deviations of that mean. Where the band stays clear of zero, something acts there \
    that has no name; the amended model carries it as a table where that pays.";

/// Standard deviations of half the band.
const BAND: f64 = 2.0;
const COLOUR: usize = 2;
const ZERO: usize = 3;

/// A chart per entry that has a curve.
pub(super) fn charts(remainder: &[Remainder]) -> Vec<Chart> {
    remainder.iter().filter_map(chart).collect()
}

fn chart(entry: &Remainder) -> Option<Chart> {
    let title = format!("{}: {}", capitalised(&place_words(entry)), percent_words(entry.share));
    let x_label = format!("{} [{}]", words(entry.axis), unit(entry.axis)?);
    let points = points(entry);
    let (first, last) = (points.first()?.0, points.last()?.0);
    let upper = points.iter().map(|&(x, y, half)| (x, y + half));
    let lower = points.iter().rev().map(|&(x, y, half)| (x, y - half));
    let middle: Vec<(f64, f64)> = points.iter().map(|&(x, y, _)| (x, y)).collect();
    let zero = Series::line("", ZERO, vec![(first, 0.0), (last, 0.0)]).stroke(Stroke::Dashed);
    let chart = Chart::new(title, x_label, "what remains [mV]")
        .with(zero)
        .with(Series::line("", COLOUR, upper.chain(lower).collect()).stroke(Stroke::Area))
        .with(Series::line("mean, 95 % band", COLOUR, middle.clone()))
        .with(Series::line("", COLOUR, middle).stroke(Stroke::Dots))
        .sized(HALF.0, HALF.1);
    Some(chart)
}

/// Place, mean and half the band [mV]; what is not finite is left out.
fn points(entry: &Remainder) -> Vec<(f64, f64, f64)> {
    let curve = &entry.curve;
    let means = curve.x.iter().zip(&curve.y_v).zip(&curve.deviation_v);
    means
        .map(|((x, y_v), deviation_v)| (*x, 1e3 * y_v, 1e3 * BAND * deviation_v))
        .filter(|(x, y, half)| x.is_finite() && y.is_finite() && half.is_finite())
        .collect()
}

fn words(axis: Axis) -> &'static str {
    if axis == Axis::Offset { axis_words(Axis::Time) } else { axis_words(axis) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use diagnosis::RemainderCurve;
    use diagnosis::synthetic::slow_friction;

    #[test]
    fn a_curve_is_drawn_with_axis_unit_and_joint() {
        let charts = charts(&[slow_friction()]);
        let svg = charts[0].to_svg();
        assert!(svg.contains("Joint 2 over velocity") && svg.contains("rad/s"), "{svg}");
        assert!(svg.contains("polygon") && svg.contains("circle"), "a band and points");
    }

    #[test]
    fn what_has_no_curve_is_not_drawn() {
        let frequency = Remainder { axis: Axis::Frequency, ..slow_friction() };
        let empty = Remainder { curve: RemainderCurve::default(), ..slow_friction() };
        assert!(charts(&[frequency, empty]).is_empty());
    }
}
