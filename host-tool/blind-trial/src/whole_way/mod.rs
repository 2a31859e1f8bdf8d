//! The whole way of a user: record, identify, something changes, record, diagnose.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`settings`] | what is drawn, with its reasons |
//! | `draw` | the robot as it was bought: body, friction, noise |
//! | `identified` | its campaign, and the model that comes of it |
//! | `change` | what changes, so large that a user notices |
//! | `run` | one case from the first record to the answer |
//! | `results`, `page`, `output` | what is printed and written |

mod change;
mod draw;
mod identified;
mod output;
mod page;
mod results;
mod run;
pub mod settings;

pub use draw::draw_robots;
pub use output::write;
pub use page::{answer, page};
pub use results::WholeWayResults;
pub use run::{WholeWayOutcome, walk};
pub use settings::WholeWaySettings;

#[cfg(test)]
mod tests;
