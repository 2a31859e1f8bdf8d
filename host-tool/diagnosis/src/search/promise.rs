//! What a start of a search promises before it is searched from.

use crate::fit::linearisation::Linearisation;
use crate::fit::row_changes::Joints;
use crate::rows::evidence::{Evidence, RowChange};
use crate::trial::hypothesis::EffectInstance;
use rig::effects::Touches;

/// Where a search may begin, and what it promises.
#[derive(Clone, Debug)]
pub(crate) struct Start {
    /// The effect with its starting values.
    pub effect: EffectInstance,
    /// Twice the log-likelihood that it promises ([`promised`]).
    pub gain: f64,
}

/// What a start promises.
pub(super) fn promised(
    linear: &Linearisation,
    evidence: &Evidence,
    effect: &EffectInstance,
) -> f64 {
    promised_by(linear, effect, &change_that_shows(linear, evidence, effect))
}

/// Change of rows by a start, of the joints on which it shows.
///
/// Another reading of an encoder bends the loads of all joints, whose parameters hide it on its own; a link that flies
/// pulls at the others; a spring shows on its own.
pub(super) fn change_that_shows(
    linear: &Linearisation,
    evidence: &Evidence,
    effect: &EffectInstance,
) -> RowChange {
    let shows_on_all = shows_on_all(effect) || effect.has_backlash();
    let joints = if shows_on_all { Joints::All } else { Joints::Own };
    linear.change_nearly_by(evidence, effect, joints)
}

fn shows_on_all(effect: &EffectInstance) -> bool {
    effect.definition.touches == Touches::READING
}

/// What a start promises by its change of rows: what that gains if it is scaled as suits best. Backlash is far from
/// linear: its promise is what the start itself gains, where that is more than nothing.
pub(super) fn promised_by(
    linear: &Linearisation,
    effect: &EffectInstance,
    change: &RowChange,
) -> f64 {
    if effect.has_backlash() {
        let squares = linear.refitted_objective() - linear.objective_with(change);
        return free_size_gain(squares, linear.squares());
    }
    let (gradient, curvature) = linear.along(&Default::default(), std::slice::from_ref(change));
    let squares = gradient[0] * gradient[0] / curvature[(0, 0)].max(1e-12);
    let all = shows_on_all(effect);
    free_size_gain(squares, if all { linear.squares() } else { linear.squares_of(effect) })
}

/// Twice the log-likelihood that rows gain whose size is free, n ln(n / (n - gain)): an effect that
/// takes nearly all that is left gains much, however few independent rows that counts for.
fn free_size_gain(gain: f64, of_squares: f64) -> f64 {
    const LEAST_LEFT: f64 = 1e-3;
    let left = 1.0 - gain.max(0.0) / of_squares.max(f64::MIN_POSITIVE);
    -of_squares * left.max(LEAST_LEFT).ln()
}
