//! The command of a log held out, and what is left of it.

use super::stages::{Stages, after, before};
use crate::diagnosis::{Diagnosis, JointResiduals, LogResiduals};
use crate::files::Role;
use crate::report::{Chart, Series, Stroke};

const HALF: (u32, u32) = (535, 270);
/// The window shown [s].
const WINDOW_S: f64 = 6.0;

/// Two charts per joint that matters: the command, and what is left of it.
pub(super) fn charts(diagnosis: &Diagnosis, stages: &Stages) -> Vec<Chart> {
    let named = !diagnosis.report.causes.is_empty();
    let held = diagnosis.logs.iter().filter(|log| log.role == Role::Holdout);
    let longest = |log: &&LogResiduals| log.time_s.len();
    let Some(log) = held.max_by_key(longest).or(diagnosis.logs.first()) else { return Vec::new() };
    let drawn = |joint: &&JointResiduals| {
        stages.joints.iter().any(|(samples, _)| samples.joint == joint.joint)
    };
    let pair = |joint: &JointResiduals| {
        let (first, last) = window(&log.time_s, before(joint, named));
        [command(log, joint, named, first, last), rest(log, joint, named, stages, first, last)]
    };
    log.joints.iter().filter(drawn).flat_map(pair).collect()
}

fn command(
    log: &LogResiduals,
    joint: &JointResiduals,
    named: bool,
    first: usize,
    last: usize,
) -> Chart {
    let left = after(joint, named);
    let reconstructed: Vec<f64> =
        joint.command_v.iter().zip(left).map(|(command, left)| command - left).collect();
    Chart::new(format!("Joint {}, {}", joint.joint, log.file), "time [s]", "command [V]")
        .with(series("recorded", 1, log, &joint.command_v, 1.0, first, last).stroke(Stroke::Broad))
        .with(series("reconstructed", 0, log, &reconstructed, 1.0, first, last))
        .sized(HALF.0, HALF.1)
}

fn rest(
    log: &LogResiduals,
    joint: &JointResiduals,
    named: bool,
    stages: &Stages,
    first: usize,
    last: usize,
) -> Chart {
    let (earlier, later) = (before(joint, named), after(joint, named));
    Chart::new(format!("Joint {}: what is left", joint.joint), "time [s]", "residual [mV]")
        .with(series(stages.names.0, 1, log, earlier, 1e3, first, last))
        .with(series(stages.names.1, 0, log, later, 1e3, first, last))
        .sized(HALF.0, HALF.1)
}

fn series(
    name: &str,
    colour: usize,
    log: &LogResiduals,
    values: &[f64],
    scale: f64,
    first: usize,
    last: usize,
) -> Series {
    let points = log.time_s.iter().copied().zip(values.iter().map(|v| scale * v));
    Series::line(name, colour, points.skip(first).take(last - first).collect())
}

/// The window, from and to before, in which most is left.
fn window(time_s: &[f64], residual_v: &[f64]) -> (usize, usize) {
    let count = time_s.len().min(residual_v.len());
    let end_of = |from: usize| time_s[..count].partition_point(|&t| t < time_s[from] + WINDOW_S);
    let energy =
        |(from, to): (usize, usize)| -> f64 { residual_v[from..to].iter().map(|r| r * r).sum() };
    let starts = (0..count).step_by((count / 40).max(1));
    let windows = starts.map(|from| (from, end_of(from)));
    let most = windows.max_by(|&a, &b| energy(a).total_cmp(&energy(b)));
    most.unwrap_or((0, count))
}
