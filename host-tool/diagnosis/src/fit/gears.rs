//! Whether the gears of an arm take a part of their motors' torque that its model does not tell.
//!
//! Teeth rub by all that they carry: what holds against gravity, what accelerates, and what friction behind them takes.
//! So a joint with friction f needs (1 + loss) (load + f) upwards and (1 - loss) (load - f) downwards: between the two
//! lies load + loss f, and gravity seems larger than it is. Load in the hand then comes out too large, unless the loss
//! is open.

use super::fitted_model::FittedModel;
use crate::logs::subject::Subject;
use crate::rows::evidence::Evidence;

/// Whether an arm's logs ask for a loss that is the same in all of its gears: a refit gains as much by it as an effect
/// must. A load that is missing may ask for it, too, and little is left of the loss once that is found.
pub fn ask_for_loss(subject: &Subject, evidence: &Evidence, without: &FittedModel) -> bool {
    if !subject.may_share_gear_loss() {
        return false;
    }
    let open = Subject { gears_lose: true, ..subject.clone() };
    let (start, steps) = (without.linear.hypothesis.clone(), subject.criteria.fit.refit_steps);
    let with = FittedModel::fitted(evidence, &open, start, steps).map(|with| with.settled(&open));
    let gain = with.map_or(0.0, |with| with.gain_over(without));
    gain > subject.criteria.selection.least_log_likelihood
}
