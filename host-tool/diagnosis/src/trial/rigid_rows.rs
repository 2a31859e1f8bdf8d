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
/// measured, a payload on a chain apart [V].
pub fn needed_rows(evidence: &Evidence, s: usize, joint: usize, trial: &Trial) -> Vec<f64> {
    let base = trial.bases();
    let make = || {
        let mut negative: Vec<f64> = trial.needed(joint).iter().map(|needed| -needed).collect();
        if let Some(payload) = trial.payload() {
            let more = trial.needed_by(&payload, joint);
            negative.iter_mut().zip(more).for_each(|(negative, more)| *negative += more);
        }
        RigidRows { base: base.clone(), rows: evidence.filter(joint, s).rows(&negative) }
    };
    let known = evidence.rigid_rows(s, joint, make);
    let mut rows = known.rows.clone();
    if base == known.base {
        return rows;
    }
    let columns = measured_columns(evidence, s, joint, trial);
    for ((column, value), before) in columns.iter().zip(&base).zip(&known.base) {
        let (Some(column), change) = (column, value - before) else { continue };
        if change != 0.0 {
            rows.iter_mut().zip(column).for_each(|(row, slope)| *row += change * slope);
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use model::reference_robot::reference_robot;
    use rig::Plant;

    use super::*;
    use crate::criteria::Criteria;
    use crate::trial::hypothesis::Hypothesis;
    use crate::trial::test_stretch::rows_of_sines;

    #[test]
    fn rows_of_the_regressor_tell_what_another_body_needs() {
        let criteria = Criteria::default();
        let evidence = rows_of_sines(&criteria);
        let given = Hypothesis::bare(Plant::of_robot(&reference_robot()));
        let mut other = given.clone();
        for k in 0..other.plant.base_count() {
            let value = other.plant.base(k);
            other.plant.set_base(k, 1.1 * value + 0.003 * k as f64);
        }
        for hypothesis in [&given, &other] {
            let trial = Trial::of(&evidence.stretches[0], hypothesis, &criteria.fit);
            for joint in 0..3 {
                let needed: Vec<f64> = trial.needed(joint).iter().map(|v| -v).collect();
                let whole = evidence.filter(joint, 0).rows(&needed);
                let rows = needed_rows(&evidence, 0, joint, &trial);
                let worst = whole.iter().zip(&rows).map(|(a, b)| (a - b).abs());
                let worst = worst.fold(0.0, f64::max);
                assert!(!rows.is_empty() && worst < 1e-9, "joint {joint}: {worst} V");
            }
        }
    }
}
