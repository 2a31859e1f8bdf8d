//! Whether friction differs from log to log.
//!
//! Grease thins as joints warm: of one robot, logs recorded cold and warm have friction that is a tenth to a third apart.
//! Left out, that stays in the rows as much as a cause of its size would, and drowns those that are smaller.

use super::fitted_model::FittedModel;
use super::gauss_newton::open_in;
use super::linearisation::Linearisation;
use super::unknowns::{Expected, Unknown};
use crate::logs::subject::Subject;

/// Part of its friction within which a joint's stays the same from log to log where that is not open.
const CLOSED: f64 = 1e-4;

/// Whether logs ask for friction that differs from log to log: on more than half of several joints it makes them likelier,
/// by the slopes of the model without it, whatever it is in each log. A machine warms as a whole; what one joint alone
/// shows is a cause there.
pub fn ask_for_warmth(subject: &Subject, without: &FittedModel) -> bool {
    let FittedModel { evidence, linear, .. } = without;
    if evidence.train_logs() < 2 || subject.joints.len() < 2 {
        return false;
    }
    let open = open_in(evidence, &Subject { warms: true, ..subject.clone() }, &linear.hypothesis);
    let Some(linear) = Linearisation::of(evidence, linear.hypothesis.clone(), open) else {
        return false;
    };
    let least = subject.criteria.prior.least_warmth_likelihood;
    let asks = |joint: &&usize| gain(&linear, **joint).is_some_and(|gain| gain > least);
    2 * subject.joints.iter().filter(asks).count() > subject.joints.len()
}

/// Logarithm of how much likelier logs are where a joint's friction differs from log to log than where it does not.
fn gain(linear: &Linearisation, joint: usize) -> Option<f64> {
    let mut closed = linear.expected.clone();
    let is_of_joint =
        |e: &&mut Expected| matches!(e.unknown, Unknown::Warmth { joint: of, .. } if of == joint);
    closed.iter_mut().filter(is_of_joint).for_each(|expected| expected.deviation = CLOSED);
    let without = linear.log_marginal_likelihood(closed)?;
    Some(linear.log_marginal_likelihood(linear.expected.clone())? - without)
}
