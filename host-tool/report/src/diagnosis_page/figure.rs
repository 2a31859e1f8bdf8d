//! A diagnosis in one picture.

use super::stages::Stages;
use super::{over_axis, waterfall};
use crate::bar_table::WIDTH;
use crate::svg::{picture, placed, rectangle};
use diagnosis::Diagnosis;

/// Height of the charts [px].
const CHARTS: f64 = over_axis::HALF.1 as f64;

/// What is left over the two axes that it varies with most, above what is left step by step.
pub fn figure(diagnosis: &Diagnosis) -> String {
    let charts = over_axis::charts(diagnosis, &Stages::of(diagnosis));
    let bars = waterfall::waterfall(diagnosis).unwrap_or_default();
    let height = CHARTS + bars.height();
    let mut body = rectangle(0.0, 0.0, WIDTH, height, "#ffffff");
    for (index, chart) in charts.iter().take(2).enumerate() {
        body += &placed(0.5 * WIDTH * index as f64, 0.0, &chart.to_svg());
    }
    body += &placed(0.0, CHARTS, &bars.to_svg());
    picture(WIDTH, height, &body)
}
