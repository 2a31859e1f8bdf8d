//! A foreign effect as a kind.

use rig::effects::{Effect, Random};

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
    pub draw: fn(joint: usize, random: &mut dyn Random) -> Vec<f64>,
    /// The effect with these values on a joint (0 to 2).
    pub build: fn(joint: usize, values: &[f64]) -> Box<dyn Effect>,
}
