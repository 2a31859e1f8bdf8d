//! A model held within the doubt about the model as given.

use crate::fit::fitted_model::FittedModel;
use crate::fit::gauss_newton::fit_held;
use crate::fit::linearisation::Linearisation;
use crate::logs::subject::Subject;
use crate::rows::evidence::Rows;
use crate::trial::residual_rows::residual_rows;

/// A model within its doubt, and what it leaves.
#[derive(Clone)]
pub struct Held {
    /// The model.
    pub linear: Linearisation,
    /// What it leaves of all rows [V].
    pub residual_v: Rows,
}

impl Held {
    /// A fitted model brought back to within the doubt about the model as given: what that can
    /// explain, and no more.
    pub fn of(subject: &Subject, model: &FittedModel) -> Self {
        let far = model.stats.asks_for_cause(&subject.criteria.fit);
        let held = far.then(|| fit_held(&model.evidence, subject, &model.linear)).flatten();
        let linear = held.unwrap_or_else(|| model.linear.clone());
        let rows = residual_rows(&model.evidence, &linear.hypothesis);
        Self { residual_v: model.evidence.volts(&rows), linear }
    }
}
