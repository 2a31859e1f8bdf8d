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
    /// Effects of the catalogue that are as right an answer on its joint: what they hold of it is
    /// most of it.
    pub equivalent: &'static [&'static str],
    /// Whether a larger first parameter is more of it, or less.
    pub grows: bool,
    /// Its parameters, with units.
    pub parameters: &'static [&'static str],
    /// Values for them, for a joint (0 to 2).
    pub draw: fn(joint: usize, random: &mut dyn Random) -> Vec<f64>,
    /// The effect with these values on a joint (0 to 2).
    pub build: fn(joint: usize, values: &[f64]) -> Box<dyn Effect>,
}
