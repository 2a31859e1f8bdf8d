//! Recorded and reconstructed command and motion of logs held out.

use super::{Chart, Page, Series, Stroke};
use identification::base_parameters::JointResidual;
use identification::procedure::HeldOutLog;
use identification::reconstruction::JointReconstruction;

const THIRD: (u32, u32) = (352, 260);

/// The page of `rrr validate`.
pub fn validation_page(held: &[HeldOutLog]) -> Page {
    let mut page = Page::new("Validation of an RRR model", &lead(held));
    page.table(&HEADER, &rows(held));
    page.paragraph(
        "Drift is that of the motion predicted from the recorded command within a quarter of a \
         second; each window begins from the measured motion.",
    );
    page.heading("Command, recorded and reconstructed");
    page.charts(&held.iter().flat_map(command_charts).collect::<Vec<_>>());
    page.heading("Drift of the predicted motion");
    page.charts(&held.iter().flat_map(drift_charts).collect::<Vec<_>>());
    page
}

/// The worst share left on any log held out, as a sentence.
pub fn lead(held: &[HeldOutLog]) -> String {
    let residuals = held.iter().flat_map(HeldOutLog::residuals);
    match residuals.max_by(|a, b| a.share.total_cmp(&b.share)) {
        Some(worst) => format!(
            "On motion held out, the model explains all but {:.2} % of the command of every \
             joint; the most is left on joint {}, {:.1} mV.",
            100.0 * worst.share,
            worst.joint,
            1e3 * worst.rms_v
        ),
        None => "No log was held out, so nothing is said of how good the model is.".into(),
    }
}

/// The header of [`rows`].
pub const HEADER: [&str; 6] =
    ["Log", "joint", "left, rms [mV]", "command, rms [V]", "share [%]", "drift, rms [mrad]"];

/// A row per log and joint.
pub fn rows(held: &[HeldOutLog]) -> Vec<Vec<String>> {
    let row = |held: &HeldOutLog, residual: JointResidual| {
        let drift_rad = held.prediction_rms_rad()[usize::from(residual.joint) - 1];
        vec![
            held.file.clone(),
            residual.joint.to_string(),
            format!("{:.1}", 1e3 * residual.rms_v),
            format!("{:.3}", residual.command_rms_v),
            format!("{:.2}", 100.0 * residual.share),
            format!("{:.3}", 1e3 * drift_rad),
        ]
    };
    held.iter().flat_map(|h| h.residuals().into_iter().map(|r| row(h, r))).collect()
}

/// Commands of a log, joint by joint.
pub fn command_charts(held: &HeldOutLog) -> Vec<Chart> {
    let Some(stretch) = held.stretches.first() else { return Vec::new() };
    let points = |values: &[f64]| -> Vec<(f64, f64)> {
        stretch.time_s.iter().copied().zip(values.iter().copied()).collect()
    };
    let chart = |(index, joint): (usize, &JointReconstruction)| {
        let left: Vec<f64> =
            joint.measured_v.iter().zip(&joint.reconstructed_v).map(|(a, b)| a - b).collect();
        Chart::new(format!("Joint {}, {}", index + 1, held.file), "time [s]", "command [V]")
            .with(Series::line("recorded", 1, points(&joint.measured_v)).stroke(Stroke::Broad))
            .with(Series::line("reconstructed", 0, points(&joint.reconstructed_v)))
            .with(Series::line("friction in it", 2, points(&joint.friction_v)))
            .with(Series::line("left", 3, points(&left)))
            .sized(THIRD.0, THIRD.1)
    };
    stretch.joints.iter().enumerate().map(chart).collect()
}

fn drift_charts(held: &HeldOutLog) -> Vec<Chart> {
    let Some(prediction) = held.predictions.first() else { return Vec::new() };
    let chart = |joint: usize| {
        let errors = prediction.error_rad[joint].iter().map(|error| 1e3 * error);
        let points = prediction.time_s.iter().copied().zip(errors).collect();
        Chart::new(format!("Joint {}, {}", joint + 1, held.file), "time [s]", "drift [mrad]")
            .with(Series::line("", 0, points))
            .sized(THIRD.0, 220)
    };
    (0..3).map(chart).collect()
}
