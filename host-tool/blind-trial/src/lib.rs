//! How well the diagnosis does on robots whose truth it cannot know.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`draw`] | draws [`Case`]s: [`robots`], [`plans`], causes with sizes that show: [`detectability`] |
//! | [`foreign`] | effects that the catalogue does not have |
//! | [`logs`] | the directory of a case, all that the diagnosis sees |
//! | [`seal`] | the truth, whose hash is told before and whose text after |
//! | [`outcome`] | writes a case's logs, has them diagnosed |
//! | [`score`] | how well the answers fit |
//! | [`results`], [`table`] | what is printed and written |

#![forbid(unsafe_code)]

pub mod case;
pub mod cause;
pub mod detectability;
pub mod draw;
pub mod error;
pub mod foreign;
pub mod logs;
pub mod outcome;
pub mod plans;
mod pool;
pub mod results;
mod rng;
pub mod robots;
pub mod score;
pub mod seal;
mod settings;
pub mod table;
pub mod visibility;

pub use case::{Case, Kind};
pub use cause::{TrueCause, TrueEffect};
pub use draw::draw;
pub use error::TrialError;
pub use outcome::{Answer, Outcome, RunSettings, diagnose_case};
pub use results::Results;
pub use rng::Rng;
pub use score::Score;
pub use seal::Seal;
pub use settings::DrawSettings;
