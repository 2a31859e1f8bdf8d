//! What is left by order over a turn and by frequency over time: cogging stands out in the one,
//! hum in the other.

use super::stages::Stages;
use crate::{Axis, Chart, Series, Stroke};
use diagnosis::gap_by_axis::orders::{best_carrier, lowest_order, orders};
use diagnosis::gap_by_axis::{Carrier, Samples, spectrum};

const HALF: (u32, u32) = (535, 290);
const BEFORE: usize = 1;
const AFTER: usize = 0;
const FLOOR: usize = 3;

/// Two charts per joint: orders, frequencies.
pub(super) fn charts(stages: &Stages) -> Vec<Chart> {
    let pair = |(before, after): &(Samples, Samples)| {
        let carrier = best_carrier(if stages.named { before } else { after });
        [
            order_chart(before, after, carrier, stages.names),
            frequency_chart(before, after, stages.names),
        ]
    };
    stages.joints.iter().flat_map(pair).collect()
}

fn order_chart(before: &Samples, after: &Samples, carrier: Carrier, names: (&str, &str)) -> Chart {
    let manner = match carrier {
        Carrier::Constant => "",
        Carrier::Direction => ", times the direction",
        Carrier::Command => ", times the command",
    };
    let title = format!("Joint {}: orders over a turn{manner}", before.joint);
    let (first, second) = (stems(before, carrier), stems(after, carrier));
    let highest = first.iter().chain(&second).map(|p| p.0).fold(10.0, f64::max);
    let lowest = lowest_order(before);
    let x_label = if lowest > 1 {
        format!("order per turn [1]; below {lowest} the range is too small")
    } else {
        "order per turn [1]".into()
    };
    Chart::new(title, x_label, "amplitude [mV]")
        .with(Series::line(names.0, BEFORE, first).stroke(Stroke::Broad))
        .with(Series::line(names.1, AFTER, second))
        .x_from_to(0.0, highest)
        .sized(HALF.0, HALF.1)
}

/// An upright line per order.
fn stems(samples: &Samples, carrier: Carrier) -> Vec<(f64, f64)> {
    let amplitudes = orders(samples, carrier).amplitude_v.into_iter().enumerate();
    let stem = |(order, v): (usize, f64)| {
        let x = order as f64;
        [(x, 0.0), (x, 1e3 * v), (x, 0.0)]
    };
    amplitudes.filter_map(|(order, v)| Some((order, v?))).flat_map(stem).collect()
}

fn frequency_chart(before: &Samples, after: &Samples, names: (&str, &str)) -> Chart {
    let (first, second) = (density(before), density(after));
    let highest_hz = first.last().map_or(1.0, |p| p.0);
    let lowest_hz = first.first().map_or(0.1, |p| p.0);
    let floor = floor_density(before, highest_hz);
    let title = format!("Joint {}: frequencies", before.joint);
    Chart::new(title, "frequency [Hz]", "density [mV/sqrt(Hz)]")
        .axes(Axis::Logarithmic, Axis::Logarithmic)
        .with(Series::line(names.0, BEFORE, first))
        .with(Series::line(names.1, AFTER, second))
        .with(
            Series::line(
                "noise, were it white",
                FLOOR,
                vec![(lowest_hz, floor), (highest_hz, floor)],
            )
            .stroke(Stroke::Dashed),
        )
        .sized(HALF.0, HALF.1)
}

fn density(samples: &Samples) -> Vec<(f64, f64)> {
    let found = spectrum(samples, &samples.residual_v).unwrap_or_default();
    let points = found.frequency_hz.into_iter().zip(found.density);
    points.skip(1).map(|(hz, density)| (hz, 1e3 * density.sqrt())).collect()
}

fn floor_density(samples: &Samples, highest_hz: f64) -> f64 {
    let mean_v2 = samples.floor_v2 / samples.len().max(1) as f64;
    1e3 * (mean_v2 / highest_hz).sqrt()
}
