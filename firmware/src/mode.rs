//! What a joint's command is made of; the schema hash is taken of this text.

use serde::{Deserialize, Serialize};

/// What a joint's command is made of; an injected voltage comes on top of each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Mode {
    /// Feedback alone, eq. (17).
    Pd,
    /// Feedback and the friction of the motion that is wanted.
    PdFriction,
    /// Feedback, friction and inverse dynamics of the motion that is wanted.
    PdModel,
    /// Compensates the friction of the motion that is measured: the second test of section 3.3.
    FrictionOnly,
    /// The injected voltage alone.
    OpenLoop,
}

impl Mode {
    /// All modes.
    pub const ALL: [Self; 5] =
        [Self::Pd, Self::PdFriction, Self::PdModel, Self::FrictionOnly, Self::OpenLoop];

    /// The name that commands and messages use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pd => "pd",
            Self::PdFriction => "pd-friction",
            Self::PdModel => "pd-model",
            Self::FrictionOnly => "friction-only",
            Self::OpenLoop => "open-loop",
        }
    }

    /// The mode of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|mode| mode.name() == name)
    }
}
