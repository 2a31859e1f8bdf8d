//! Tables for what remains once all causes are in the model.

use super::ceiling::{excess_left_v2, part_taken, with_best_table};
use crate::fit::fitted_model::FittedModel;
use crate::logs::subject::Subject;

/// The model with tables for what remains of each joint, as long as one pays on pieces of logs that
/// it was not fitted to.
pub fn with_remaining_tables(subject: &Subject, model: &FittedModel) -> FittedModel {
    let policy = &subject.criteria.selection;
    let mut last = model.clone();
    for &joint in &subject.joints {
        for _ in 0..policy.tables_of_joint {
            if excess_left_v2(subject, &last, joint) <= 0.0 {
                break;
            }
            let Some(best) = with_best_table(subject, &last, joint) else { break };
            let pays = best.gain > policy.least_log_likelihood
                && part_taken(subject, &last, &best.model, joint) > policy.least_of_table;
            if !pays {
                break;
            }
            last = best.model;
        }
    }
    last
}
