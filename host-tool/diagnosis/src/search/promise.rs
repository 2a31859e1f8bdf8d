//! What a start of a search promises before it is searched from.

use crate::fit::linearisation::Linearisation;
use crate::fit::row_changes::Joints;
use crate::rows::evidence::Evidence;
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

/// What a start promises. Backlash is far from linear: its promise is what the start itself gains, where that
/// is more than nothing, on all joints, for a link that flies pulls at the others.
pub(super) fn promised(
    linear: &Linearisation,
    evidence: &Evidence,
    effect: &EffectInstance,
) -> f64 {
    if !effect.has_backlash() {
        return promise(linear, evidence, effect);
    }
    let change = linear.change_nearly_by(evidence, effect, Joints::All);
    let squares = linear.refitted_objective() - linear.objective_with(&change);
    free_size_gain(squares, linear.squares())
}

/// Twice the log-likelihood that the change of rows by an effect would gain if it were scaled as
/// suits best.
///
/// Another reading of an encoder bends the loads of all joints, whose parameters hide it on its own; a
/// spring shows on its own.
pub(crate) fn promise(linear: &Linearisation, evidence: &Evidence, effect: &EffectInstance) -> f64 {
    let shows_on_all = effect.definition.touches == Touches::READING;
    let joints = if shows_on_all { Joints::All } else { Joints::Own };
    let change = linear.change_nearly_by(evidence, effect, joints);
    let (gradient, curvature) = linear.along(&Default::default(), &[change]);
    let squares = gradient[0] * gradient[0] / curvature[(0, 0)].max(1e-12);
    let of_squares = if shows_on_all { linear.squares() } else { linear.squares_of(effect) };
    free_size_gain(squares, of_squares)
}

/// Twice the log-likelihood that rows gain whose size is free, n ln(n / (n - gain)): an effect that
/// takes nearly all that is left gains much, however few independent rows that counts for.
fn free_size_gain(gain: f64, of_squares: f64) -> f64 {
    const LEAST_LEFT: f64 = 1e-3;
    let left = 1.0 - gain.max(0.0) / of_squares.max(f64::MIN_POSITIVE);
    -of_squares * left.max(LEAST_LEFT).ln()
}
