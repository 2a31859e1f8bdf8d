//! Which law of friction a joint's data carry: static friction, eq. (10), or LuGre's bristles, eq. (9).
//!
//! A joint whose friction follows its velocity alone, or gives in to any force, has no bristles.
//! LuGre's law fitted to it ends at a stiffness that means nothing: millions where friction jumps,
//! a few volts per radian where it creeps. Both laws are therefore fitted, and each predicts what
//! it was not fitted to.
//!
//! # Evidence from sliding and reversals
//! The excitation is cut in halves; each law, with all parameters, is refined on one half and
//! reconstructs the command of the other. With S_b and L_b the squares that static friction and
//! LuGre's leave of block b, d_b = (S_b - L_b) / (S_b + L_b): a few large reversals do not decide
//! alone. Where bristles carry nothing, d_b is as often above zero as below, and
//! (Efron, J. Am. Stat. Assoc. 64, 1969) P(sum d_b > x sqrt(sum d_b^2)) <= exp(-x^2 / 2) whatever
//! the distribution of each. [`CERTAIN`] is the x at which this is 1 in 1000.
//!
//! # Evidence from pre-sliding
//! Bristles that reversals are too quick to show may show in the FRF, eq. (12): its sigma0 is then
//! [`CERTAIN`] standard errors above zero. A joint that creeps shows damping there and no stiffness.
//!
//! # Bounds
//! A stiffness beyond what encoder and FRF leave open is none that the data carry, however well it
//! fits: see `largest_stiffness`.
//!
//! Where nothing speaks for bristles the joint has static friction. The model's readers need
//! numbers all the same: see `stiffness`.
//!
//! | module | what it holds |
//! | --- | --- |
//! | `certainty` | how sure a figure must be |
//! | `evidence` | what each law leaves of what it was not fitted to |
//! | `halves` | logs cut in halves |
//! | `largest_stiffness` | the largest sigma0 that data can speak for |
//! | `static_friction` | static friction as the limit of stiff bristles |
//! | `stiffness` | how soft bristles may be before the data object |

mod certainty;
mod evidence;
mod halves;
mod largest_stiffness;
mod static_friction;
mod stiffness;

use model::Friction;
use serde::Serialize;

use crate::base_parameters::FrictionEstimate;
use crate::presliding::Presliding;
pub use certainty::CERTAIN;
pub(crate) use certainty::stiffness_in_errors;
use evidence::{Evidence, blocks_of, carried_by};
use halves::halves;
use largest_stiffness::largest_stiffness;
use recordings::campaign::{Known, Trace};
pub(crate) use static_friction::{as_static, note_chosen_bristles};
use stiffness::softest;

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
    fn of(
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
        let figures = figures.join("; ");
        format!("joint {}: {} friction ({figures})", self.joint, self.law.name())
    }
}

/// The laws of all joints, and friction by them as the prior of the refinement.
///
/// `lugre` and `still` are friction by either law, as the steps before found it.
pub(crate) fn choose(
    excitations: &[&Trace],
    known: &Known,
    lugre: &[FrictionEstimate; 3],
    still: &[FrictionEstimate; 3],
    presliding: &[Presliding],
) -> ([FrictionLaw; 3], [FrictionEstimate; 3]) {
    let folds = halves(excitations);
    let (by_lugre, by_static) =
        rayon::join(|| carried_by(&folds, known, lugre), || carried_by(&folds, known, still));
    let evidence = |i: usize| {
        let (lugre, still) = (by_lugre.as_ref()?, by_static.as_ref()?);
        Evidence::of(&blocks_of(lugre, i), &blocks_of(still, i))
    };
    let laws = [0, 1, 2].map(|i| {
        let joint = i as u8 + 1;
        let frf = presliding.iter().find(|p| p.joint == joint);
        // The stiffest of what either half says.
        let friction = by_lugre.iter().flatten().map(|fitted| fitted.robot.friction[i]);
        let friction = friction.fold(lugre[i].value, |stiffest, friction| {
            let is_stiffer = friction.sigma0_v_per_rad > stiffest.sigma0_v_per_rad;
            if is_stiffer { friction } else { stiffest }
        });
        FrictionLaw::of(joint, evidence(i), frf, &friction, known.encoder_step_rad)
    });
    let stands = |i: usize| laws[i].law == Law::Static;
    let stiffness = by_static.filter(|_| (0..3).any(stands)).map(|fitted| softest(&folds, &fitted));
    let friction = [0, 1, 2].map(|i| match (stands(i), &stiffness) {
        (true, Some(stiffness)) => static_friction::with_stiffness(&still[i], stiffness[i]),
        (true, None) => still[i],
        (false, _) => lugre[i],
    });
    (laws, friction)
}
