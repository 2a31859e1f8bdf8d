//! An arm fitted to its logs, commands held from row to row or sampled at the rows.

use files::ArmFile;
use nalgebra::DMatrix;

use super::condensed::Condensed;
use super::error::ArmError;
use super::fit::{Fit, fit};
use super::layout::Layout;
use super::logs::PreparedLog;
use super::motion::CommandTime;
use super::rows::{Equations, JointRows};
use super::settings::Settings;
use super::unknowns::Unknowns;
use super::weights::{left_of, weights};

/// What is found where commands act at a given time.
pub struct Fitted {
    /// When they do.
    pub time: CommandTime,
    /// Which joints have rows enough.
    pub moves: Vec<bool>,
    /// All rows, condensed and weighted.
    pub rows: DMatrix<f64>,
    /// The numbers found.
    pub found: Fit,
    /// Logarithm of what is left of a joint's command, typically, mean over rows.
    misfit: f64,
}

/// Commands held or sampled, whichever leaves less by what is known of the arm: parameters that are free make up for
/// commands at the wrong time, the more so where friction leads velocity.
///
/// # Errors
/// No joint moves, or the logs leave a parameter open, however the commands act.
pub fn likelier(
    arm: &ArmFile,
    logs: &[PreparedLog],
    equations: &Equations,
    settings: &Settings,
) -> Result<Fitted, ArmError> {
    let [held, sampled] = [CommandTime::Held, CommandTime::Sampled]
        .map(|time| Fitted::of(arm, logs, equations, time, settings));
    match (held, sampled) {
        (Ok(held), Ok(sampled)) if sampled.misfit < held.misfit => Ok(sampled),
        (Err(_), Ok(sampled)) => Ok(sampled),
        (held, _) => held,
    }
}

impl Fitted {
    fn of(
        arm: &ArmFile,
        logs: &[PreparedLog],
        equations: &Equations,
        time: CommandTime,
        settings: &Settings,
    ) -> Result<Self, ArmError> {
        let layout = Layout { joints: equations.constants.len() };
        let all: Vec<JointRows> =
            logs.iter().flat_map(|log| log.rows(equations, time, settings)).collect();
        let counts: Vec<usize> = (0..layout.joints).map(|joint| count(&all, joint)).collect();
        let moves: Vec<bool> = counts.iter().map(|count| *count >= settings.fewest_rows).collect();
        if !moves.contains(&true) {
            return Err(ArmError::NoMotion);
        }
        let condensed = Condensed::of(&all, layout);
        let rows = condensed.weighted(&weights(&all, &condensed, layout, settings));
        let found = fit(&rows, Unknowns::of(arm, &scales(logs), settings), settings)?;
        let numbers = found.numbers();
        let of_joint = |(joint, count): (usize, &usize)| {
            *count as f64 * typical_left(&all, joint, &numbers, layout).ln()
        };
        let moving = || counts.iter().enumerate().filter(|(joint, _)| moves[*joint]);
        let misfit = moving().map(of_joint).sum::<f64>()
            / moving().map(|(_, count)| *count as f64).sum::<f64>();
        Ok(Self { time, moves, rows, found, misfit })
    }
}

/// The median of what the numbers leave of a joint's command, in size: where it turns round, friction that leads or lags
/// velocity is early or late by itself.
fn typical_left(rows: &[JointRows], joint: usize, numbers: &[f64], layout: Layout) -> f64 {
    let left = left_of(rows, joint, numbers, layout);
    let mut sizes: Vec<f64> = left.into_iter().flatten().map(f64::abs).collect();
    sizes.sort_by(f64::total_cmp);
    sizes.get(sizes.len() / 2).copied().unwrap_or_default().max(f64::MIN_POSITIVE)
}

/// Rows of a joint.
fn count(rows: &[JointRows], joint: usize) -> usize {
    let of_joint = rows.iter().filter(|rows| rows.joint == joint);
    of_joint.map(|rows| rows.command.len()).sum()
}

fn scales(logs: &[PreparedLog]) -> Vec<[f64; 2]> {
    let larger = |a: Vec<[f64; 2]>, b: Vec<[f64; 2]>| {
        a.iter().zip(&b).map(|(a, b)| [a[0].max(b[0]), a[1].max(b[1])]).collect()
    };
    logs.iter().map(PreparedLog::scales).reduce(larger).unwrap_or_default()
}
