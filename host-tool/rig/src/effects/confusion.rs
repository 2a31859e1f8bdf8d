//! What an effect is confused with.

/// Two things that logs may not tell apart.
#[derive(Clone, Copy, Debug)]
pub struct Confusion {
    /// With what.
    pub with: Confused,
    /// Why.
    pub why: &'static str,
    /// What tells them apart.
    pub told_apart_by: &'static str,
    /// Whether a diagnosis compares the two and says where its logs do not tell them apart.
    pub compared: bool,
    /// Whether they are one thing under two names, so that no blind trial hides both on a joint.
    pub never_paired: bool,
}

/// What an effect is confused with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Confused {
    /// Another effect, by its name.
    Effect(&'static str),
    /// A part of the model, in words.
    Model(&'static str),
}

impl Confusion {
    /// A confusion with another effect.
    pub const fn effect(
        effect: &'static str,
        why: &'static str,
        told_apart_by: &'static str,
    ) -> Self {
        let with = Confused::Effect(effect);
        Self { with, why, told_apart_by, compared: false, never_paired: false }
    }

    /// A confusion with a part of the model.
    pub const fn model(part: &'static str, why: &'static str, told_apart_by: &'static str) -> Self {
        Self { with: Confused::Model(part), ..Self::effect("", why, told_apart_by) }
    }

    /// The same, compared in each diagnosis.
    pub const fn compared(self) -> Self {
        Self { compared: true, ..self }
    }

    /// The same, of two that are never drawn as a pair.
    pub const fn never_paired(self) -> Self {
        Self { never_paired: true, ..self }
    }
}
