//! A law of friction, and why it was taken.

use model::Friction;
use serde::Serialize;

use super::certainty::{CERTAIN, stiffness_in_errors};
use super::evidence::Evidence;
use super::largest_stiffness::largest_stiffness;
use crate::presliding::Presliding;

/// A law of friction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Law {
    /// Eq. (10): friction is a function of the velocity.
    Static,
    /// Eq. (9): bristles that bend before they slide.
    #[serde(rename = "LuGre")]
    LuGre,
}

impl Law {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Static => "static",
            Self::LuGre => "LuGre",
        }
    }
}

/// The law of friction of a joint, and why.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FrictionLaw {
    /// Joint, 1 to 3.
    pub joint: u8,
    /// The law.
    pub law: Law,
    /// Sliding and reversals; `None` where the excitation is too short to be cut in halves.
    pub excitation: Option<Evidence>,
    /// sigma0 of the FRF over its standard error; `None` without an FRF.
    pub presliding_stiffness: Option<f64>,
    /// sigma0 by LuGre's law [V/rad].
    #[serde(rename = "lugre_sigma0_V_per_rad")]
    pub lugre_sigma0_v_per_rad: f64,
    /// The largest sigma0 that encoder and pre-sliding data leave open [V/rad].
    #[serde(rename = "largest_sigma0_V_per_rad")]
    pub largest_sigma0_v_per_rad: f64,
}

impl FrictionLaw {
    pub(super) fn of(
        joint: u8,
        excitation: Option<Evidence>,
        presliding: Option<&Presliding>,
        lugre: &Friction<f64>,
        encoder_step_rad: f64,
    ) -> Self {
        let mut law = Self {
            joint,
            law: Law::LuGre,
            excitation,
            presliding_stiffness: presliding.map(stiffness_in_errors),
            lugre_sigma0_v_per_rad: lugre.sigma0_v_per_rad,
            largest_sigma0_v_per_rad: largest_stiffness(lugre, encoder_step_rad, presliding),
        };
        if !law.has_bristles() {
            law.law = Law::Static;
        }
        law
    }

    fn has_bristles(&self) -> bool {
        let shows = |figure: Option<f64>| figure.is_some_and(|x| x > CERTAIN);
        // Nothing was compared where the excitation is too short.
        let carried = self.excitation.is_none_or(|evidence| evidence.certainty > CERTAIN)
            || shows(self.presliding_stiffness);
        carried && self.lugre_sigma0_v_per_rad <= self.largest_sigma0_v_per_rad
    }

    /// The law with the figures that decided, in a sentence.
    pub fn sentence(&self) -> String {
        let mut figures = Vec::new();
        if let Some(evidence) = &self.excitation {
            figures.push(evidence.words());
        }
        if let Some(stiffness) = self.presliding_stiffness {
            figures.push(format!("the FRF's sigma0 is {stiffness:.1} standard errors above 0"));
        }
        let (found, largest) = (self.lugre_sigma0_v_per_rad, self.largest_sigma0_v_per_rad);
        if found > largest {
            figures.push(format!(
                "LuGre's sigma0 of {found:.0} V/rad is beyond the {largest:.0} V/rad that encoder \
                 and pre-sliding data leave open"
            ));
        }
        if figures.is_empty() {
            figures.push("no log tells it from static friction".to_owned());
        }
        let figures = figures.join("; ");
        format!("joint {}: {} friction ({figures})", self.joint, self.law.name())
    }
}
