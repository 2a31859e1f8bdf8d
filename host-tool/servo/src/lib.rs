//! Arms of position servos: simulated from their goals, refitted and diagnosed on motion.
#![forbid(unsafe_code)]


pub mod along;
pub mod arm_replay;
pub mod base;
pub mod candidates;
pub mod cogging_orders;
pub mod confirm;
pub mod contact;
pub mod cross;
pub mod effect_table;
pub mod error;
pub mod fit;
pub mod goal_clip;
pub mod joint;
pub mod judged;
pub mod motion;
pub mod outcome;
pub mod pieces;
pub mod pooled;
pub mod prepared;
pub mod record;
pub mod replay;
pub mod report_types;
pub mod selection;
pub mod settings;
pub mod step;
pub mod verdict;
pub mod whole_arm;
pub mod whole_cause;
pub mod whole_normal;

pub use error::ServoError;
pub use outcome::Outcome;
pub use joint::ServoJoint;
pub use settings::Settings;
