//! Links, rotors and friction of an arm of any kind, from logs of any motion.
//!
//! Commands are linear in link parameters and friction; the search is over bodies that matter can
//! have, with what is given of whole links as prior.
//!
//! | file | step |
//! | --- | --- |
//! | `settings.rs` | every choice with its reason |
//! | `drives.rs` | what a command is worth at the joint |
//! | `stretch.rs` | stretches of a log on an even clock |
//! | `noise.rs`, `band.rs` | the band in which the log speaks |
//! | `motion.rs` | smoothed motion and command |
//! | `layout.rs`, `rows.rs`, `logs.rs` | rows of the regression, where a joint moves |
//! | `condensed.rs`, `weights.rs` | all rows as few, weighted by what the fit leaves |
//! | `linear.rs` | least squares without regard to what is physical |
//! | `link_prior.rs`, `own_prior.rs` | what is thought of link, rotor and friction before |
//! | `friction_terms.rs`, `choice_of_terms.rs` | what friction has beyond Coulomb's level and viscous friction |
//! | `fitting.rs`, `fitted.rs` | rows of all logs, and what is found by them |
//! | `unknowns.rs`, `fit.rs` | the search for the possible arm that leaves least |
//! | `base.rs`, `judge.rs`, `remarks.rs` | how good it is |
//! | `model_file.rs`, `result.rs` | what is written |
//! | `procedure.rs` | **all steps together** |

mod band;
mod base;
mod choice_of_terms;
mod condensed;
mod drives;
mod error;
mod fit;
mod fitted;
mod fitting;
mod friction_terms;
mod judge;
mod layout;
mod linear;
mod link_prior;
mod logs;
mod model_file;
mod motion;
mod noise;
mod own_prior;
mod procedure;
mod remarks;
mod result;
mod rows;
mod settings;
mod stretch;
mod unknowns;
mod weights;

pub use base::BaseParameter;
pub use error::ArmError;
pub use judge::{JointLeft, LogLeft};
pub use motion::CommandTime;
pub use procedure::identify;
pub use result::{Estimate, FoundTerms, IdentifiedArm, LogBand};
pub use settings::Settings;
