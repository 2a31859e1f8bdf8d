//! Why an effect is refused.

/// Why an effect is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EffectError {
    /// No effect of the catalogue has this name.
    #[error("{name} is no effect; the catalogue has {known}")]
    Unknown {
        /// The name.
        name: String,
        /// Those of the catalogue.
        known: String,
    },
    /// The effect acts elsewhere.
    #[error("{effect} acts on {right}, not on joint {joint}")]
    Joint {
        /// The effect.
        effect: &'static str,
        /// Where it acts.
        right: &'static str,
        /// The joint given.
        joint: u8,
    },
    /// A parameter is missing, or there is one too many.
    #[error("{effect} takes {expected}, but {found} is given")]
    Parameters {
        /// The effect.
        effect: &'static str,
        /// The parameters that it has.
        expected: String,
        /// Those given.
        found: String,
    },
    /// A value that is not a number, or out of bounds.
    #[error("{parameter} of {effect} is {value}, but must be from {lowest} to {highest}")]
    Value {
        /// The effect.
        effect: &'static str,
        /// The parameter.
        parameter: &'static str,
        /// The value given.
        value: f64,
        /// The least allowed.
        lowest: f64,
        /// The most allowed.
        highest: f64,
    },
    /// Text of another form.
    #[error("`{0}` is not of the form effect:joint:name=value,name=value")]
    Form(String),
}
