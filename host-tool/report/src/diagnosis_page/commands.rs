//! The command of a log held out, and what is left of it.

use super::stages::{Stages, after, before};
use crate::{Chart, Series, Stroke};
use diagnosis::{Diagnosis, JointResiduals, LogResiduals};
use files::Role;

const HALF: (u32, u32) = (535, 270);
/// The shortest and the longest window that is shown [s].
const WINDOW_S: (f64, f64) = (0.5, 6.0);
/// Periods of what is left that the eye can tell apart.
const PERIODS: f64 = 40.0;

/// Four charts per joint that matters: the command and what is left of it, where most is left and over
/// the whole log.
pub(super) fn charts(diagnosis: &Diagnosis, stages: &Stages) -> Vec<Chart> {
    let named = !diagnosis.report.causes.is_empty();
    let held = diagnosis.logs.iter().filter(|log| log.role == Role::Holdout);
    let longest = |log: &&LogResiduals| log.time_s.len();
    let Some(log) = held.max_by_key(longest).or(diagnosis.logs.first()) else { return Vec::new() };
    let drawn = |joint: &&JointResiduals| {
        stages.joints.iter().any(|(samples, _)| samples.joint == joint.joint)
    };
    let pair = |joint: &JointResiduals| {
        let window = window(&log.time_s, before(joint, named));
        let whole = (0, log.time_s.len());
        let of = |window| {
            let piece = Piece { log, joint, window };
            [piece.command(after(joint, named)), piece.rest(stages)]
        };
        [of(window), of(whole)].concat()
    };
    log.joints.iter().filter(drawn).flat_map(pair).collect()
}

/// What is shown of a log.
struct Piece<'a> {
    log: &'a LogResiduals,
    joint: &'a JointResiduals,
    window: (usize, usize),
}

impl Piece<'_> {
    fn command(&self, left_v: &[f64]) -> Chart {
        let command_v = &self.joint.command_v;
        let reconstructed: Vec<f64> =
            command_v.iter().zip(left_v).map(|(command, left)| command - left).collect();
        let title = format!("Joint {}, {}", self.joint.joint, self.log.file);
        Chart::new(title, "time [s]", "command [V]")
            .with(Series::line("recorded", 5, self.points(command_v, 1.0)).stroke(Stroke::Wide))
            .with(Series::line("reconstructed", 0, self.points(&reconstructed, 1.0)))
            .detailed()
            .sized(HALF.0, HALF.1)
    }

    fn rest(&self, stages: &Stages) -> Chart {
        let earlier = self.points(before(self.joint, stages.named), 1e3);
        let later = self.points(after(self.joint, stages.named), 1e3);
        let title = format!("Joint {}: what is left", self.joint.joint);
        Chart::new(title, "time [s]", "residual [mV]")
            .with(Series::line(stages.names.0, 1, earlier))
            .with(Series::line(stages.names.1, 0, later))
            .detailed()
            .sized(HALF.0, HALF.1)
    }

    fn points(&self, values: &[f64], scale: f64) -> Vec<(f64, f64)> {
        let points = self.log.time_s.iter().copied().zip(values.iter().map(|v| scale * v));
        points.skip(self.window.0).take(self.window.1 - self.window.0).collect()
    }
}

/// The window, from and to before, in which most is left.
fn window(time_s: &[f64], residual_v: &[f64]) -> (usize, usize) {
    let count = time_s.len().min(residual_v.len());
    let (time_s, residual_v) = (&time_s[..count], &residual_v[..count]);
    let length_s = (PERIODS / typical_hz(time_s, residual_v)).clamp(WINDOW_S.0, WINDOW_S.1);
    let end_of = |from: usize| time_s.partition_point(|&t| t < time_s[from] + length_s);
    let energy =
        |(from, to): (usize, usize)| -> f64 { residual_v[from..to].iter().map(|r| r * r).sum() };
    let starts = (0..count).step_by((count / 40).max(1));
    let windows = starts.map(|from| (from, end_of(from)));
    let most = windows.max_by(|&a, &b| energy(a).total_cmp(&energy(b)));
    most.unwrap_or((0, count))
}

/// The frequency of the sine with the same ratio of slope to size [Hz].
fn typical_hz(time_s: &[f64], values: &[f64]) -> f64 {
    let steps = time_s.windows(2).zip(values.windows(2));
    let (mut slopes, mut squares) = (0.0, f64::MIN_POSITIVE);
    for (t, v) in steps.filter(|(t, _)| t[1] > t[0]) {
        slopes += ((v[1] - v[0]) / (t[1] - t[0])).powi(2);
        squares += v[1] * v[1];
    }
    ((slopes / squares).sqrt() / std::f64::consts::TAU).max(f64::MIN_POSITIVE)
}
