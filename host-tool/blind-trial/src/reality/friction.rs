//! The law of friction that a joint really has.

use model::friction::Friction;
use serde::Serialize;
use simulation::friction_law::{
    Dahl, FrictionLaw, LuGre, MaxwellSlip, RegularisedCoulomb, Slope, SoftConstraint, StribeckLag,
    Warming, Warmth,
};

/// A law with what it needs beyond the joint's alpha0, alpha1 and alpha2.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(tag = "law", rename_all = "snake_case")]
#[allow(missing_docs)] // the names say it; `simulation::friction_law` has the equations
pub enum Law {
    /// As the diagnosis takes it to be.
    Lugre,
    /// Coulomb friction with tanh(v / w) for its sign.
    Tanh { width_rad_per_s: f64 },
    /// Coulomb friction with v / w, held at +-1, for its sign.
    Ramp { width_rad_per_s: f64 },
    /// Dahl's, with this part of sigma0.
    Dahl { relative_stiffness: f64 },
    /// Generalised Maxwell slip.
    MaxwellSlip { elements: usize, spread: f64, attraction_per_s: f64 },
    /// Stribeck friction that follows the speed late.
    StribeckLag { lag_s: f64, stribeck_factor: f64 },
    /// MuJoCo's soft constraint.
    SoftConstraint { creep_rad_per_s: f64 },
}

/// How friction falls with its own work.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Heat {
    /// By which part it falls when warm.
    pub fall: f64,
    /// Time constant [s].
    pub time_constant_s: f64,
    /// Mean power that warms the joint, in parts of what friction takes at 1 rad/s.
    pub relative_power: f64,
}

/// The friction of one joint.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct JointFriction {
    /// The law.
    #[serde(flatten)]
    pub law: Law,
    /// Whether it warms.
    pub heat: Option<Heat>,
}

impl JointFriction {
    /// LuGre friction that stays as it is.
    pub const LUGRE: Self = Self { law: Law::Lugre, heat: None };

    /// The law with a joint's parameters, cold and at rest.
    pub fn build(&self, friction: &Friction<f64>) -> Box<dyn FrictionLaw> {
        let law = self.law.build(friction);
        let Some(heat) = self.heat else { return law };
        let warmth = Warmth {
            fall: heat.fall,
            time_constant_s: heat.time_constant_s,
            power_v_rad_per_s: heat.relative_power * friction.sliding(1.0),
        };
        Box::new(Warming::new(law, warmth))
    }
}

impl Law {
    /// Its name, in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Lugre => "LuGre",
            Self::Tanh { .. } => "Coulomb, tanh",
            Self::Ramp { .. } => "Coulomb, ramp",
            Self::Dahl { .. } => "Dahl",
            Self::MaxwellSlip { .. } => "Maxwell slip",
            Self::StribeckLag { .. } => "Stribeck with lag",
            Self::SoftConstraint { .. } => "soft constraint",
        }
    }

    fn build(self, friction: &Friction<f64>) -> Box<dyn FrictionLaw> {
        let friction = *friction;
        match self {
            Self::Lugre => Box::new(LuGre::new(friction)),
            Self::Tanh { width_rad_per_s } => {
                Box::new(RegularisedCoulomb::new(friction, Slope::Tanh, width_rad_per_s))
            }
            Self::Ramp { width_rad_per_s } => {
                Box::new(RegularisedCoulomb::new(friction, Slope::Ramp, width_rad_per_s))
            }
            Self::Dahl { relative_stiffness } => {
                Box::new(Dahl::new(friction, relative_stiffness * friction.sigma0_v_per_rad))
            }
            Self::MaxwellSlip { elements, spread, attraction_per_s } => {
                Box::new(MaxwellSlip::new(friction, elements, spread, attraction_per_s))
            }
            Self::StribeckLag { lag_s, stribeck_factor } => {
                let velocity = stribeck_factor * friction.stribeck_velocity_rad_per_s;
                Box::new(StribeckLag::new(friction, lag_s, velocity))
            }
            Self::SoftConstraint { creep_rad_per_s } => {
                Box::new(SoftConstraint::new(friction, creep_rad_per_s))
            }
        }
    }
}
