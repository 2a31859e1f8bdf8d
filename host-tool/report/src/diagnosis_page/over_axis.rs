//! What is left over the axis that it varies with most: means with their spread.

use std::f64::consts::TAU;

use super::stages::Stages;
use super::units::unit;
use crate::{Chart, Series, Stroke};
use diagnosis::gap_by_axis::orders::best_carrier;
use diagnosis::gap_by_axis::{Carrier, Samples};
use diagnosis::report::words::axis_words;
use diagnosis::{Axis, Diagnosis, GapShare};

pub(super) const HALF: (u32, u32) = (535, 290);
const BINS: usize = 72;
const LEAST_IN_BIN: usize = 8;
const MOST_CHARTS: usize = 4;

/// A chart per share that has an axis to draw over, the largest first.
pub(super) fn charts(diagnosis: &Diagnosis, stages: &Stages) -> Vec<Chart> {
    let drawn = diagnosis.report.gap_shares.iter().filter_map(|share| {
        let (before, after) = stages.joints.iter().find(|(b, _)| b.joint == share.joint)?;
        // Where nothing is named, the shares are those of the refitted model.
        if diagnosis.report.causes.is_empty() {
            chart(share, &[(after, stages.names.1, 1)])
        } else {
            chart(share, &[(before, stages.names.0, 1), (after, stages.names.1, 0)])
        }
    });
    drawn.take(MOST_CHARTS).collect()
}

fn chart(share: &GapShare, residuals: &[(&Samples, &str, usize)]) -> Option<Chart> {
    let title = format!("Joint {}: {}", share.joint, share.detail);
    let carrier = carrier(share, residuals.first()?.0);
    let y_label = match carrier {
        Carrier::Constant => "residual [mV]",
        Carrier::Direction => "residual times direction [mV]",
        Carrier::Command => "residual times command by its rms [mV]",
    };
    let mut chart = Chart::new(title, label(share.axis)?, y_label).sized(HALF.0, HALF.1);
    for (samples, name, colour) in residuals {
        let carried: Vec<f64> =
            carrier.values(samples).iter().zip(&samples.residual_v).map(|(c, r)| c * r).collect();
        let means = binned(variable(samples, share.axis)?, &carried);
        let pieces = means.chunk_by(|a, b| b.0 == a.0 + 1);
        for (index, piece) in pieces.enumerate() {
            let named = if index == 0 { format!("{name}: mean, spread") } else { String::new() };
            let [area, line] = outline(piece, named, *colour);
            chart = chart.with(area).with(line);
        }
    }
    Some(chart)
}

/// Mean and spread over bins without a gap between them.
fn outline(piece: &[Bin], name: String, colour: usize) -> [Series; 2] {
    let upper = piece.iter().map(|&(_, x, mean, spread)| (x, mean + spread));
    let lower = piece.iter().rev().map(|&(_, x, mean, spread)| (x, mean - spread));
    let middle = piece.iter().map(|&(_, x, mean, _)| (x, mean)).collect();
    [
        Series::line("", colour, upper.chain(lower).collect()).stroke(Stroke::Area),
        Series::line(name, colour, middle),
    ]
}

/// Number and middle of a bin, mean and standard deviation in it.
type Bin = (usize, f64, f64, f64);

/// What the residual is multiplied by, so that what changes sign with it does not average out.
fn carrier(share: &GapShare, samples: &Samples) -> Carrier {
    match share.axis {
        Axis::Position => best_carrier(samples),
        Axis::Load | Axis::Time if share.detail.contains("friction") => Carrier::Direction,
        _ => Carrier::Constant,
    }
}

fn label(axis: Axis) -> Option<String> {
    let within = if axis == Axis::Position { ", within a turn" } else { "" };
    let has_course = axis != Axis::Offset;
    let unit = unit(axis).filter(|_| has_course)?;
    Some(format!("{} [{unit}{within}]", axis_words(axis)))
}

fn variable(samples: &Samples, axis: Axis) -> Option<Vec<f64>> {
    Some(match axis {
        Axis::Position => within_a_turn(&samples.position_rad),
        Axis::Velocity => samples.velocity_rad_per_s.clone(),
        Axis::Acceleration => samples.acceleration_rad_per_s2.clone(),
        Axis::Command => samples.command_v.clone(),
        Axis::Load => samples.load_nm.clone(),
        Axis::Time => samples.time_s.clone(),
        Axis::Frequency | Axis::Offset => return None,
    })
}

/// Angles as they are where they stay within a turn, else what is left of whole turns.
fn within_a_turn(position_rad: &[f64]) -> Vec<f64> {
    let low = position_rad.iter().copied().fold(f64::INFINITY, f64::min);
    let high = position_rad.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let turns = high - low > TAU;
    position_rad.iter().map(|q| if turns { q.rem_euclid(TAU) } else { *q }).collect()
}

/// The bins that hold enough, of the residual in mV.
fn binned(variable: Vec<f64>, residual_v: &[f64]) -> Vec<Bin> {
    let low = variable.iter().copied().fold(f64::INFINITY, f64::min);
    let high = variable.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let width = (high - low).max(f64::MIN_POSITIVE) / BINS as f64;
    let mut sums = [(0usize, 0.0, 0.0); BINS];
    for (x, r) in variable.iter().zip(residual_v) {
        let (count, sum, squares) = &mut sums[(((x - low) / width) as usize).min(BINS - 1)];
        (*count, *sum, *squares) = (*count + 1, *sum + 1e3 * r, *squares + 1e6 * r * r);
    }
    let full = sums.iter().enumerate().filter(|(_, (count, ..))| *count >= LEAST_IN_BIN);
    full.map(|(bin, &(count, sum, squares))| {
        let mean = sum / count as f64;
        let deviation = (squares / count as f64 - mean * mean).max(0.0).sqrt();
        (bin, low + width * (bin as f64 + 0.5), mean, deviation)
    })
    .collect()
}
