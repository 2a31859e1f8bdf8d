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
    /// A choice that is none.
    #[error("{parameter} of {effect} is {value}, but must be {lowest} or {highest}")]
    Choice {
        /// The effect.
        effect: &'static str,
        /// The parameter.
        parameter: &'static str,
        /// The value given.
        value: f64,
        /// The one.
        lowest: f64,
        /// The other.
        highest: f64,
    },
    /// A table whose axis is none.
    #[error("axis of table is `{found}`, but must be one of {known}")]
    TableAxis {
        /// The axis given.
        found: String,
        /// The axes that there are.
        known: String,
    },
    /// Too few knots, too many, or not as many as values.
    #[error(
        "table has {knots} knots and {values} values_V; give as many values_V as knots, \
         {fewest} to {most} of them"
    )]
    TableLength {
        /// Number of knots.
        knots: usize,
        /// Number of values.
        values: usize,
        /// The least number of both.
        fewest: usize,
        /// The greatest number of both.
        most: usize,
    },
    /// Knots that do not increase.
    #[error(
        "knots of table must increase, but {next} comes after {before}; sort them, and leave out \
         those given twice"
    )]
    TableOrder {
        /// A knot.
        before: f64,
        /// The knot after it, which is not above it.
        next: f64,
    },
    /// Text of another form.
    #[error(
        "`{0}` is not of the form effect:joint:name=value,name=value; a vector is x y z, with spaces"
    )]
    Form(String),
}
