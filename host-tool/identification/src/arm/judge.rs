//! What the model leaves of the command on a log.

use serde::Serialize;
use signal::rms;

use super::friction_terms::Term;
use super::layout::Layout;
use super::rows::JointRows;
use super::weights::residuals;

/// One joint on one log, where it moves; in the unit of its command.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct JointLeft {
    /// Rms of what is left.
    pub rms: f64,
    /// Rms of the command.
    pub command_rms: f64,
    /// The first by the second.
    pub share: f64,
}

/// All joints on one log; `None` of one that stands.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LogLeft {
    /// File name.
    pub file: String,
    /// Base to tip.
    pub joints: Vec<Option<JointLeft>>,
}

/// Judges the numbers on the rows of a log; constants do not count, since no
/// model holds them.
pub fn judged(file: &str, rows: &[JointRows], numbers: &[f64], layout: Layout) -> LogLeft {
    let mut numbers = numbers.to_vec();
    (0..layout.joints).for_each(|joint| numbers[layout.own(joint) + Term::Constant.number()] = 0.0);
    let of_joint = |joint: usize| {
        let rows: Vec<_> = rows.iter().filter(|rows| rows.joint == joint).collect();
        let left: Vec<f64> =
            rows.iter().flat_map(|rows| residuals(rows, &numbers, layout)).collect();
        let command: Vec<f64> = rows.iter().flat_map(|rows| rows.command.clone()).collect();
        let (left_rms, command_rms) = (rms(&left), rms(&command));
        let found = JointLeft { rms: left_rms, command_rms, share: left_rms / command_rms };
        (!left.is_empty() && command_rms > 0.0).then_some(found)
    };
    LogLeft { file: file.to_owned(), joints: (0..layout.joints).map(of_joint).collect() }
}
