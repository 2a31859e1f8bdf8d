//! What is thought of a joint's rotor and friction before the logs are seen.

use files::ArmJoint;

use super::settings::Settings;

/// A value with its doubt; `None` where nothing is known.
pub type Prior = Option<(f64, f64)>;

/// Doubt of an exact value, in parts of it, for the search alone.
const EXACT: f64 = 1e-5;

/// A rotor before the logs are seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rotor {
    /// Known exactly, as none is.
    Fixed(f64),
    /// Given with a doubt.
    Given(f64, f64),
    /// Unknown; searched from here.
    Unknown(f64),
}

impl Rotor {
    /// Of a joint whose link has about this inertia seen at the joint [kg m^2; kg].
    pub fn of(joint: &ArmJoint, inertia: f64, settings: &Settings) -> Self {
        let error = joint.standard_error(&joint.armature_name()).and_then(|e| e.first().copied());
        match (joint.armature, error) {
            (None, _) => Self::Unknown(0.1 * inertia),
            (Some(value), error) => {
                let doubt = error.unwrap_or(settings.doubt_of_link * value);
                let exact = doubt <= EXACT * value;
                if exact || value == 0.0 { Self::Fixed(value) } else { Self::Given(value, doubt) }
            }
        }
    }
}

/// Coulomb level and viscous coefficient of a joint as given.
pub fn friction_priors(joint: &ArmJoint, settings: &Settings) -> [Prior; 2] {
    let friction = joint.friction.unwrap_or_default();
    let names = joint.friction_names();
    [(friction.alpha0, 0), (friction.alpha2, 3)].map(|(value, name)| {
        let value = value?;
        let error = joint.standard_error(&names[name]).and_then(|errors| errors.first());
        let doubt = error.copied().unwrap_or(settings.doubt_of_friction * value.abs());
        // No doubt of nothing: friction that is said to be none is unknown.
        (doubt > 0.0 || value != 0.0).then(|| (value, doubt.max(EXACT * value.abs())))
    })
}
