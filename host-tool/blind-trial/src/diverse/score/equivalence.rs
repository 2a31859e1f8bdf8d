//! Names for one and the same thing: the sets that count as one answer, for all cases alike.
//!
//! They are few: those that the catalogue itself calls one thing under two names, where the logs
//! of a trial hold nothing that tells them apart; and what a foreign shape says it is nearest to.

use crate::cause::{TrueCause, TrueEffect};
use crate::claim::Claim;
use diagnosis::Value;

/// Two names for one thing on a joint, and where they are that.
struct Pair {
    names: [&'static str; 2],
    /// Whether it holds for a true cause (with its parameters) and a joint.
    holds: fn(vertical: bool, joint: u8) -> bool,
}

const PAIRS: [Pair; 4] = [
    // Both turn the phase by omega T; they differ in the second order of omega T alone.
    Pair { names: ["actuator_lag", "delay"], holds: |_, _| true },
    // A gap that is small against the spring's own give is a spring, and both ring.
    Pair { names: ["joint_elasticity", "backlash"], holds: |_, _| true },
    // A force straight up or down is a weight but for its inertia.
    Pair { names: ["payload", "tip_force"], holds: |vertical, _| vertical },
    // On joint 2 the load is a function of the angle.
    Pair { names: ["position_friction", "load_friction"], holds: |_, joint| joint == 2 },
];

/// A force is vertical where that much of it is.
const VERTICAL_PART: f64 = 0.95;

/// Whether a claim names a true cause, by one of its names.
pub fn names(claim: &Claim, truth: &TrueCause) -> bool {
    if claim.joint != truth.joint {
        return false;
    }
    if claim.effect == truth.effect {
        return true;
    }
    if let TrueEffect::Foreign(definition) = truth.kind {
        return definition.equivalent.contains(&claim.effect.as_str());
    }
    let vertical = is_vertical(truth.parameters.get("force_N"))
        || is_vertical(claim.parameters.get("force_N"));
    PAIRS.iter().any(|pair| {
        let both = [claim.effect.as_str(), truth.effect.as_str()];
        pair.names.iter().all(|name| both.contains(name)) && (pair.holds)(vertical, claim.joint)
    })
}

/// Whether a claim names one of several causes on one joint that only show as one: a constant
/// beside a spring is a spring that rests elsewhere, -k (q - q0) + c.
pub fn names_within(claim: &Claim, truth: &TrueCause, all: &[TrueCause]) -> bool {
    let is_hidden = truth.effect == "dac_offset" && claim.effect == "cable_spring";
    let beside = |other: &TrueCause| other.effect == "cable_spring" && other.joint == truth.joint;
    names(claim, truth) || (is_hidden && claim.joint == truth.joint && all.iter().any(beside))
}

/// Whether any name of the catalogue is right for a cause.
pub fn can_be_named(truth: &TrueCause) -> bool {
    match truth.kind {
        TrueEffect::Catalogue(_) => true,
        TrueEffect::Foreign(definition) => !definition.equivalent.is_empty(),
    }
}

fn is_vertical(force: Option<&Value>) -> bool {
    let Some(Value::Vector(force)) = force else { return false };
    let whole = force.iter().map(|f| f * f).sum::<f64>().sqrt();
    force.get(2).is_some_and(|up| up.abs() >= VERTICAL_PART * whole)
}
