//! What a table and its parameters are called in files.

/// The effect.
pub const NAME: &str = "table";
/// The parameter that names the axis.
pub const AXIS: &str = "axis";
/// The parameter with the knots.
pub const KNOTS: &str = "knots";
/// The parameter with the values.
pub const VALUES_V: &str = "values_V";
