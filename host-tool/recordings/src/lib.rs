//! Recorded experiments in radians and volts, and whether they are plausible.
//!
//! ```no_run
//! use files::{Dataset, RobotFile};
//! use recordings::{Campaign, plausibility};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let robot = RobotFile::read("campaign/robot.toml")?;
//! let campaign = Campaign::read(&Dataset::read("campaign")?, robot)?;
//! for trace in &campaign.traces {
//!     println!("{}: {} samples", trace.file, trace.len());
//!     for remark in plausibility::examine(trace, &campaign.known)? {
//!         println!("  {remark}");
//!     }
//! }
//! # Ok(())
//! # }
//! ```
#![forbid(unsafe_code)]

pub mod arm;
pub mod campaign;
mod error;
pub mod motion;
pub mod one_joint;
pub mod plausibility;
pub mod smoothed;
pub mod tracking;
mod unbroken;
pub mod wrong_positions;

pub use arm::{ArmCampaign, ArmRecording};
pub use campaign::{Campaign, JointTrace, Known, Trace};
pub use error::StepError;
pub use tracking::Tracking;
pub use unbroken::unbroken;
