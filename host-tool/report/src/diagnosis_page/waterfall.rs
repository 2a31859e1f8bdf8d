//! The gap step by step.

use crate::{BarRow, BarTable};
use diagnosis::Diagnosis;
use diagnosis::report::sentence::joint_numbers;

/// What the picture shows.
pub(super) const CAPTION: &str = "Rms of the residual on the logs that chose nothing; the broken line is what noise alone leaves. Joints of one unit are on one scale.";

const BEFORE: &str = "#d55e00";
const AFTER: &str = "#0072b2";
const TABLES: &str = "#009e73";
const NOISE: &str = "#9a9a9a";

/// A row of bars per level, a column per joint; `None` without levels.
pub(super) fn waterfall(diagnosis: &Diagnosis) -> Option<BarTable> {
    if diagnosis.waterfall.is_empty() {
        return None;
    }
    let millivolts = |values: &[f64]| values.iter().map(|v| 1e3 * v).collect::<Vec<f64>>();
    let rows = diagnosis.waterfall.iter().enumerate().map(|(index, level)| BarRow {
        name: level.name.clone(),
        values: millivolts(&level.rms_v),
        colour: match index {
            _ if level.name.contains("noise") => NOISE,
            _ if level.name.contains("tables") => TABLES,
            0 | 1 => BEFORE,
            _ => AFTER,
        },
    });
    let joints = joint_numbers(diagnosis);
    let columns = joints.iter().map(|joint| format!("joint {joint}"));
    let units = joints.iter().map(|&joint| diagnosis.units_of(joint).in_words("mV"));
    Some(BarTable {
        columns: columns.collect(),
        rows: rows.collect(),
        marks: millivolts(&diagnosis.report.gap.noise_floor_v),
        units: units.collect(),
    })
}
