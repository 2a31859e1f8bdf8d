//! What the rigid body needs of train rows along the measured motion.
//!
//! Its torque is linear in the base parameters, eq. (6), and so are rows, which come of it by a filter: rows of the
//! regressor, which the slopes are made of anyway, tell what a body with other parameters needs, and no torque is
//! computed again for each of the models that a fit goes through.

use super::equation::Trial;
use crate::rows::evidence::{Columns, Evidence, RigidRows};

/// Rows of the regressor along the measured motion without weights, what is needed counted as negative.
pub fn measured_columns<'a>(
    evidence: &'a Evidence,
    s: usize,
    joint: usize,
    trial: &Trial,
) -> &'a Columns {
    evidence.regressor(s, joint, || base_columns(evidence, s, joint, trial))
}

/// The same along the motion of a trial's links.
pub fn base_columns(evidence: &Evidence, s: usize, joint: usize, trial: &Trial) -> Columns {
    let rows = |mut raw: Vec<f64>| {
        raw.iter_mut().for_each(|r| *r = -*r);
        evidence.filter(joint, s).rows(&raw)
    };
    trial.regressor_columns(joint).into_iter().map(|column| column.map(rows)).collect()
}

/// Rows of what the rigid body of a trial needs, counted as negative, without weights: of one whose links move as
/// measured, and whose body no effect changes [V].
pub fn needed_rows(evidence: &Evidence, s: usize, joint: usize, trial: &Trial) -> Vec<f64> {
    let base = trial.bases();
    let make = || {
        let negative: Vec<f64> = trial.needed(joint).iter().map(|needed| -needed).collect();
        RigidRows { base: base.clone(), rows: evidence.filter(joint, s).rows(&negative) }
    };
    let known = evidence.rigid_rows(s, joint, make);
    let mut rows = known.rows.clone();
    let columns = measured_columns(evidence, s, joint, trial);
    for ((column, value), before) in columns.iter().zip(&base).zip(&known.base) {
        let (Some(column), change) = (column, value - before) else { continue };
        if change != 0.0 {
            rows.iter_mut().zip(column).for_each(|(row, slope)| *row += change * slope);
        }
    }
    rows
}
