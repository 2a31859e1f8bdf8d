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
        Some(worst) if worst.share > 1.0 => format!(
            "On motion held out, the model explains nothing of the command of joint {}: it leaves {:.1} mV, \
             more than the {:.1} mV that were commanded.",
            worst.joint,
            1e3 * worst.rms_v,
            1e3 * worst.command_rms_v
        ),
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

/// Commands of a log, joint by joint, and below each what is left of it, on an axis of its own; over the
/// whole log.
pub fn command_charts(held: &HeldOutLog) -> Vec<Chart> {
    let commands = (0..3).map(|joint| command_chart(held, joint));
    commands.chain((0..3).map(|joint| left_chart(held, joint))).collect()
}

/// The title of a joint's chart.
fn title(held: &HeldOutLog, joint: usize) -> String {
    format!("Joint {}, {}", joint + 1, held.file)
}

fn command_chart(held: &HeldOutLog, joint: usize) -> Chart {
    let chart = Chart::new(title(held, joint), "time [s]", "command [V]").sized(THIRD.0, THIRD.1);
    let chart = of_stretches(chart, held, joint, "recorded", 5, |joint, k| joint.measured_v[k]);
    let chart = chart.restroked(Stroke::Wide);
    let chart =
        of_stretches(chart, held, joint, "reconstructed", 0, |joint, k| joint.reconstructed_v[k]);
    of_stretches(chart, held, joint, "friction in it", 2, |joint, k| joint.friction_v[k]).detailed()
}

fn left_chart(held: &HeldOutLog, joint: usize) -> Chart {
    let title = format!("Left of {}", title(held, joint));
    let chart = Chart::new(title, "time [s]", "left [mV]").sized(THIRD.0, 200);
    let left = |joint: &JointReconstruction, k: usize| {
        1e3 * (joint.measured_v[k] - joint.reconstructed_v[k])
    };
    of_stretches(chart, held, joint, "", 1, left).detailed()
}

/// A chart with a line for each unbroken stretch of the log, one name for all.
fn of_stretches(
    chart: Chart,
    held: &HeldOutLog,
    joint: usize,
    name: &str,
    colour: usize,
    value: impl Fn(&JointReconstruction, usize) -> f64,
) -> Chart {
    held.stretches.iter().enumerate().fold(chart, |chart, (place, stretch)| {
        let joint = &stretch.joints[joint];
        let times = stretch.time_s.iter().enumerate();
        let points = times.map(|(k, time_s)| (*time_s, value(joint, k))).collect();
        let name = if place == 0 { name } else { "" };
        chart.with(Series::line(name, colour, points))
    })
}

fn drift_charts(held: &HeldOutLog) -> Vec<Chart> {
    let chart = |joint: usize| {
        let empty = Chart::new(title(held, joint), "time [s]", "drift [mrad]")
            .sized(THIRD.0, 220)
            .detailed();
        held.predictions.iter().fold(empty, |chart, prediction| {
            let errors = prediction.error_rad[joint].iter().map(|error| 1e3 * error);
            let points = prediction.time_s.iter().copied().zip(errors).collect();
            chart.with(Series::line("", 0, points))
        })
    };
    (0..3).map(chart).collect()
}
