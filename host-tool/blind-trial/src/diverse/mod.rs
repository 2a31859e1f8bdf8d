//! The diverse trial: robots that do not share friction, effects and noise with the diagnosis.

mod beside;
mod clutter;
mod draw;
mod earlier;
mod evidence;
mod knowable;
mod outcome;
mod output;
mod page;
mod results;
mod run;
mod score;
mod settings;
mod sizes;
mod told;
mod world;

pub use draw::{DiverseCase, draw_diverse};
pub use earlier::Earlier;
pub use knowable::Known;
pub use outcome::DiverseOutcome;
pub use output::{append, write, write_known};
pub use page::{answer, page, short};
pub use results::DiverseResults;
pub(crate) use run::diagnose_written;
pub use run::{DiagnoseWhole, diagnose_diverse};
pub use score::DiverseScore;
pub(crate) use score::{KNOWABLE, names};
pub use settings::{DiverseSettings, FrictionRanges, Ranges};
pub(crate) use sizes::scaled;
pub use told::true_effects;
pub(crate) use world::draw_law_among;

#[cfg(test)]
mod tests;
