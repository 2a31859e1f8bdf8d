//! Blind trials of other arms: one kind of arm at a time, one hidden effect or none in each.
//!
//! | module | what it holds |
//! | --- | --- |
//! | `kind` | the kinds of arms, each with its model |
//! | `truth` | an arm that is not quite its model |
//! | `typical`, `sizes`, `places` | how large effects are drawn, and where |
//! | `case`, `draw` | cases |
//! | `logs` | the directory of a case, all that the diagnosis sees |
//! | `oracle` | what somebody could know who knows the arm |
//! | `run`, `outcome` | what the diagnosis makes of a case |
//! | `score`, `page`, `output` | how well the answers fit |

mod case;
mod draw;
mod kind;
mod logs;
mod oracle;
mod outcome;
mod output;
mod page;
mod places;
mod run;
mod score;
mod sizes;
mod truth;
mod typical;

pub use case::ArmCase;
pub use draw::{ArmTrialSettings, draw_arms};
pub use kind::ArmKind;
pub use outcome::ArmOutcome;
pub use output::{append, write};
pub use page::{ArmResults, answer, short};
pub use run::{DiagnoseArm, diagnose_arm_case, record_arm_case};

#[cfg(test)]
mod tests;
