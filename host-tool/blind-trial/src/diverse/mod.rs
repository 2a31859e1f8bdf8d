//! The diverse trial: robots that do not share friction, effects and noise with the diagnosis.

mod clutter;
mod draw;
mod evidence;
mod knowable;
mod settings;
mod sizes;
mod world;

pub use draw::{DiverseCase, draw_diverse};
pub use knowable::Known;
pub use settings::{DiverseSettings, Ranges};

#[cfg(test)]
mod tests;
