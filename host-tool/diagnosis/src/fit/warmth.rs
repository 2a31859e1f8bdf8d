//! Whether friction differs from log to log.
//!
//! Grease thins as joints warm: of one robot, logs recorded cold and warm have friction that is a tenth to a third apart.
//! Left out, that stays in the rows as much as a cause of its size would, and drowns those that are smaller.

use super::fitted_model::FittedModel;
use super::gauss_newton::open_in;
use super::linearisation::Linearisation;
use super::unknowns::Unknown;
use crate::criteria::Criteria;
use crate::logs::stretch::Stretch;
use crate::logs::subject::Subject;
use crate::trial::active_effects::is_scaled;
use files::Role;

/// Part of its friction within which a joint's stays the same from log to log where that is not open.
const CLOSED: f64 = 1e-4;

/// Whether logs could tell: there are several of several joints.
pub fn may_warm(subject: &Subject, stretches: &[Stretch]) -> bool {
    let mut train = stretches.iter().filter(|stretch| stretch.role == Role::Train);
    let first = train.next().map(|stretch| stretch.log);
    subject.joints.len() > 1 && train.any(|stretch| Some(stretch.log) != first)
}

/// Whether logs ask for friction that differs from log to log: on more than half of several joints it makes them likelier,
/// by the slopes of the model without it, whatever it is in each log. A machine warms as a whole; what one joint alone
/// shows is a cause there. On one joint at least it must be likelier than friction that is off by the same in all logs, which
/// is the model's.
pub fn ask_for_warmth(subject: &Subject, without: &FittedModel) -> bool {
    let FittedModel { evidence, linear, .. } = without;
    if !may_warm(subject, &evidence.stretches) {
        return false;
    }
    let asking = Subject { warms: true, ..subject.clone() };
    let open = open_in(evidence, &asking, &linear.hypothesis);
    let Some(linear) = Linearisation::of(evidence, linear.hypothesis.clone(), open) else {
        return false;
    };
    let prior = &subject.criteria.prior;
    let gains = |off: f64| -> Vec<f64> {
        subject.joints.iter().filter_map(|&joint| gain(&linear, joint, off)).collect()
    };
    let asks = |gain: &&f64| **gain > prior.least_warmth_likelihood;
    let most = 2 * gains(0.0).iter().filter(asks).count() > subject.joints.len();
    most && gains(prior.warmth).iter().any(|gain| asks(&gain))
}

/// Whether a model that a search ended with gains by friction that differs from log to log: on more than half of several
/// joints, and in all as much as an effect must. By its own slopes it would not show: what warmth leaves hangs together
/// over a log, and rows weigh little by that. Before a search a fit must not tell, for warmth follows causes as far as it
/// can.
pub fn gains_by_warmth(subject: &Subject, without: &FittedModel) -> bool {
    let FittedModel { evidence, linear, .. } = without;
    if !may_warm(subject, &evidence.stretches) {
        return false;
    }
    let asking = Subject { warms: true, ..subject.clone() };
    let start = linear.hypothesis.clone();
    let steps = subject.criteria.fit.refit_steps;
    let Some(with) = FittedModel::fitted(evidence, &asking, start, steps) else { return false };
    let Criteria { prior, selection, .. } = &subject.criteria;
    let asks = |joint: &&usize| with.gain_on(without, **joint) > prior.least_warmth_likelihood;
    2 * subject.joints.iter().filter(asks).count() > subject.joints.len()
        && with.gain_over(without) > selection.least_log_likelihood
}

/// Logarithm of how much likelier logs are where a joint's friction differs from log to log than where it is the same in
/// all of them, and off from the model's by so many parts of itself more than is thought.
fn gain(linear: &Linearisation, joint: usize, off: f64) -> Option<f64> {
    let mut alike = linear.expected.clone();
    for expected in &mut alike {
        match expected.unknown {
            Unknown::Warmth { joint: of, .. } if of == joint => expected.deviation = CLOSED,
            Unknown::Friction { joint: of, parameter } if of == joint && is_scaled(parameter) => {
                expected.deviation = expected.deviation.hypot(off * expected.mean);
            }
            _ => {}
        }
    }
    let without = linear.log_marginal_likelihood(alike)?;
    Some(linear.log_marginal_likelihood(linear.expected.clone())? - without)
}
