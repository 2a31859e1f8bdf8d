//! How well the diagnosis does on robots whose truth it cannot know.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`draw`] | draws [`Case`]s: [`robots`], [`plans`], causes with sizes that show: [`detectability`] |
//! | [`foreign`] | effects that the catalogue does not have |
//! | [`logs`] | the directory of a case, all that the diagnosis sees |
//! | [`sealed_truth`] | the truth: its hash is printed before, its text written after |
//! | [`outcome`] | writes a case's logs, has them diagnosed |
//! | [`score`] | how well the answers fit |
//! | [`diverse`] | robots that share neither friction nor noise with the diagnosis |
//! | [`arms`] | arms of other kinds |
//! | [`whole_way`] | record, identify, a change, record, diagnose |
//! | [`results`], [`markdown`], [`output`] | what is printed and written |

#![forbid(unsafe_code)]

pub mod answer;
pub mod arms;
pub mod case;
pub mod cause;
pub mod claim;
pub mod detectability;
pub mod diverse;
pub mod draw;
pub mod error;
pub mod foreign;
pub mod logs;
pub mod markdown;
pub mod outcome;
pub mod output;
pub mod plans;
mod population;
pub mod reality;
pub mod results;
mod rng;
pub mod robots;
pub mod score;
pub mod sealed_truth;
mod settings;
mod thread_time;
pub mod visibility;
pub mod whole_way;

pub use answer::Answer;
pub use case::{Case, Kind};
pub use cause::{TrueCause, TrueEffect};
pub use draw::draw;
pub use error::TrialError;
pub use outcome::{Outcome, RunSettings, diagnose_case};
pub use results::Results;
pub use rng::Rng;
pub use score::Score;
pub use sealed_truth::SealedTruth;
pub use settings::DrawSettings;
