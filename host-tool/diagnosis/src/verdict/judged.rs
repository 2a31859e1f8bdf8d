//! What effects amount to that the search found, and why some are not named.

use super::worth::Worth;
use crate::trial::hypothesis::EffectInstance;

/// What an effect amounts to.
#[derive(Clone, Copy, Debug)]
pub struct Judged {
    /// Its worth as it is told.
    pub worth: Worth,
    /// Its worth by which it is judged, joints in units of what is left on each.
    pub weighed: Worth,
    /// The probability that it is a cause.
    pub probability: f64,
}

/// An effect that was taken out of the model.
#[derive(Clone, Debug)]
pub struct Unconfirmed {
    /// The effect.
    pub effect: EffectInstance,
    /// What it amounts to.
    pub judged: Judged,
    /// Why it is not named.
    pub reason: Reason,
}

/// Why an effect that the search found is not named.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// Its probability is below one half.
    Unlikely,
    /// The whole model is far from what is known of the arm.
    ImplausibleModel,
    /// The logs of a joint on which it acts are as of another robot.
    AnotherRobot,
    /// A spring between motor and link that may take less than half of what is left without it.
    SmallSpring,
    /// A spring where the logs held out are near their noise, or that leaves less than the noise.
    SpringNearNoise,
    /// What goes with it on the logs held out is not its own doing.
    Idle,
    /// Lengths within their doubt would do the same.
    Lengths,
    /// It takes too small a part of the gap, or of what is left without it.
    Small,
    /// Its share may be nothing.
    NoShare,
    /// It is not sure while most stays, or is near the noise and takes less than half of what is left.
    MostStays,
    /// A curve along one axis takes more.
    Ceiling,
}

impl Reason {
    /// In words, after the effect and a colon.
    pub fn words(self) -> &'static str {
        match self {
            Self::Unlikely => "less likely than not",
            Self::ImplausibleModel => "the model is far from what is known of the arm",
            Self::AnotherRobot => "the logs of its joint are as of another robot",
            Self::SmallSpring => "a spring must surely take half of what is left without it",
            Self::SpringNearNoise => "near the noise a spring may only smooth what encoders read",
            Self::Idle => "it hardly acts on the logs held out",
            Self::Lengths => "lengths a few per cent off would do the same",
            Self::Small => "too small a part of what is left",
            Self::NoShare => "its share may be nothing",
            Self::MostStays => "not sure enough where most of the gap stays or noise is near",
            Self::Ceiling => "a curve along one axis explains more",
        }
    }
}
