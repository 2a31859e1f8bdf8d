//! Maps of the residual over position and velocity.

use std::f64::consts::TAU;

use super::stages::Stages;
use crate::HeatMap;
use diagnosis::Diagnosis;
use diagnosis::gap_by_axis::Samples;

const COLUMNS: usize = 80;
const ROWS: usize = 26;

/// Two maps per joint, on one scale.
pub(super) fn maps(diagnosis: &Diagnosis, stages: &Stages) -> Vec<String> {
    let pair = |(before, after): &(Samples, Samples)| {
        let first = map(before, stages.names.0);
        let limit = strongest(&first.cells);
        let second = map(after, stages.names.1);
        let units = diagnosis.units_of(before.joint);
        let drawn = |map: HeatMap| HeatMap {
            limit,
            x_label: units.in_words(&map.x_label),
            y_label: units.in_words(&map.y_label),
            value_label: units.in_words(&map.value_label),
            ..map
        };
        [first, second].map(|map| drawn(map).to_svg())
    };
    stages.joints.iter().flat_map(pair).collect()
}

/// Means of the residual [mV] in cells; a joint that turns more than once is shown over a turn.
fn map(samples: &Samples, name: &str) -> HeatMap {
    let (low, high) = range(&samples.position_rad);
    let turns = high - low > TAU;
    let x_range = if turns { (0.0, TAU) } else { (low, high) };
    let y_range = range(&samples.velocity_rad_per_s);
    let mut sums = vec![vec![(0.0, 0usize); COLUMNS]; ROWS];
    for k in 0..samples.len() {
        let angle = samples.position_rad[k];
        let angle = if turns { angle.rem_euclid(TAU) } else { angle };
        let row = index(samples.velocity_rad_per_s[k], y_range, ROWS);
        let cell = &mut sums[row][index(angle, x_range, COLUMNS)];
        *cell = (cell.0 + 1e3 * samples.residual_v[k], cell.1 + 1);
    }
    let mean = |&(sum, count): &(f64, usize)| if count > 0 { sum / count as f64 } else { f64::NAN };
    HeatMap {
        title: format!("Joint {}, {name}", samples.joint),
        x_label: if turns { "position within a turn [rad]" } else { "position [rad]" }.into(),
        y_label: "velocity [rad/s]".into(),
        value_label: "residual, mean [mV]".into(),
        x_range,
        y_range,
        cells: sums.iter().map(|row| row.iter().map(mean).collect()).collect(),
        limit: 1.0,
    }
}

fn range(values: &[f64]) -> (f64, f64) {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if high > low { (low, high) } else { (low - 0.5, low + 0.5) }
}

fn index(value: f64, range: (f64, f64), count: usize) -> usize {
    let part = (value - range.0) / (range.1 - range.0);
    ((part * count as f64) as usize).min(count - 1)
}

/// The size that all but the strongest two per cent of the cells stay below.
fn strongest(cells: &[Vec<f64>]) -> f64 {
    let mut sizes: Vec<f64> =
        cells.iter().flatten().filter(|v| v.is_finite()).map(|v| v.abs()).collect();
    sizes.sort_unstable_by(f64::total_cmp);
    let at = (0.98 * sizes.len() as f64) as usize;
    sizes.get(at.min(sizes.len().saturating_sub(1))).copied().unwrap_or(1.0).max(1e-6)
}
