//! What a blind trial draws.

use super::case::Kind;

/// What is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawSettings {
    /// Same seed, same cases.
    pub seed: u32,
    /// Number of the first case.
    pub first: u32,
    /// How many cases.
    pub cases: u32,
    /// Only cases of this kind.
    pub kind: Option<Kind>,
    /// Only these effects, by name; all where it is empty.
    pub only: Vec<String>,
    /// All durations of the recipe times this.
    pub duration_scale: f64,
    /// Amplifier noise [V rms]; drawn where it is not given.
    pub noise_v: Option<f64>,
}
