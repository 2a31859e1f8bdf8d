//! What is known of a foreign effect.

use crate::Rng;
use rig::effects::Effect;

/// A foreign effect of one joint, as a kind.
#[derive(Debug)]
pub struct Definition {
    /// Its name.
    pub name: &'static str,
    /// What it is, in words.
    pub words: &'static str,
    /// Effects of the catalogue for which it may be taken.
    pub resembles: &'static [&'static str],
    /// Its parameters, with units.
    pub parameters: &'static [&'static str],
    /// Values for them, for a joint (0 to 2).
    pub draw: fn(joint: usize, rng: &mut Rng) -> Vec<f64>,
    /// The effect with these values on a joint (0 to 2).
    pub build: fn(joint: usize, values: &[f64]) -> Box<dyn Effect>,
}
