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
    /// The probability that it is a cause, by this name or by another that says the same.
    pub probability: f64,
    /// The same by this name.
    pub by_name: f64,
    /// Whether it counts by all that goes with it: it acts on the confirming logs, or surely takes much. Else it is judged
    /// by what little it does there.
    pub counts_in_full: bool,
    /// Share of all that goes with it, joints in units of what is left on each.
    pub share_with_it: f64,
}

/// An effect that was taken out of the model, and is not named.
#[derive(Clone, Debug)]
pub struct Withheld {
    /// The effect.
    pub effect: EffectInstance,
    /// What it amounts to.
    pub judged: Judged,
    /// Why it is not named.
    pub reason: Reason,
    /// What is likeliest in its place, where that is why.
    pub rival: Option<EffectInstance>,
}

/// Why an effect that the search found is not named.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// Its probability is below one half: chance may be all of it.
    Unlikely,
    /// Its probability would be one half or more, but for what does the same in its place.
    Rival,
    /// Parameters are far from what is known of the arm.
    ImplausibleModel,
    /// The logs of a joint on which it acts are as of another robot.
    AnotherRobot,
    /// A spring where the logs held out are near their noise, or that leaves less than their noise.
    SpringNearNoise,
    /// What goes with it on the logs held out is not its own doing, and what is takes too little.
    Idle,
    /// A lag or delay that is not the same in every part of the logs, as that of a drive is.
    Unsteady,
    /// A spring between motor and link whose stiffness the logs do not tell, where none of another motion is held out.
    LooseSpring,
    /// A wave of voltage at the order of a larger one of friction that is named on its joint.
    WaveOfFriction,
    /// Lengths within their doubt would do the same.
    Lengths,
    /// It takes too small a part of the gap, or of what is left without it.
    Small,
    /// Its share may be nothing.
    NoShare,
    /// There is no gap above the noise, and its size may be nothing.
    NoSize,
    /// It is not sure, and most of the gap stays.
    MostStays,
    /// There is no gap above the noise, and it takes less than half of what is left.
    NearNoise,
    /// A curve along one axis takes more.
    Ceiling,
    /// A lag or delay, of which a tone of one frequency takes more.
    Tone,
}

impl Reason {
    /// All reasons.
    pub const ALL: [Self; 17] = [
        Self::Unlikely,
        Self::Rival,
        Self::ImplausibleModel,
        Self::AnotherRobot,
        Self::SpringNearNoise,
        Self::Idle,
        Self::Unsteady,
        Self::LooseSpring,
        Self::WaveOfFriction,
        Self::Lengths,
        Self::Small,
        Self::NoShare,
        Self::NoSize,
        Self::MostStays,
        Self::NearNoise,
        Self::Ceiling,
        Self::Tone,
    ];

    /// In words, as they stand in brackets behind an effect.
    pub fn words(self) -> &'static str {
        match self {
            Self::Unlikely => "less likely than not",
            Self::Rival => "another effect may do the same",
            Self::ImplausibleModel => {
                "refitted parameters are further from the file's than their doubt allows"
            }
            Self::AnotherRobot => "a joint on which it acts does not fit this model",
            Self::SpringNearNoise => {
                "the gap is near the noise, or less than noise is left: a spring may only smooth encoder steps"
            }
            Self::Idle => "it hardly acts on the logs held out",
            Self::Unsteady => {
                "its time is uncertain, or differs between logs, by more than a fifth: play does that, a drive does not"
            }
            Self::LooseSpring => {
                "a spring whose stiffness is uncertain by more than three fifths, and no log of another motion is held out"
            }
            Self::WaveOfFriction => {
                "friction of this joint varies with the same order, and leaves such a wave if its law is not the model's"
            }
            Self::Lengths => "lengths off within their doubt, a tenth, would do the same",
            Self::Small => "too small a part of the gap or of what is left",
            Self::NoShare => "its share may be nothing",
            Self::NoSize => "no gap above the noise, and its size may be nothing",
            Self::MostStays => "not sure enough, and most of the gap stays",
            Self::NearNoise => {
                "no gap above the noise, and it takes less than half of what is left"
            }
            Self::Ceiling => "a curve along one axis explains more",
            Self::Tone => "a tone of one frequency explains more: a supply that hums, say",
        }
    }
}
