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
pub mod identified;
pub mod joint;
pub mod judged;
pub mod model_file;
pub mod motion;
pub mod outcome;
pub mod pieces;
pub mod pooled;
pub mod prepared;
pub mod record;
pub mod replay;
pub mod report;
pub mod report_changes;
pub mod report_gap;
pub mod report_intervals;
pub mod report_places;
pub mod report_remarks;
pub mod report_types;
pub mod selection;
pub mod settings;
pub mod spread;
pub mod step;
pub mod synthetic;
pub mod verdict;
pub mod whole_arm;
pub mod whole_cause;
pub mod whole_normal;
pub mod whole_table;

pub use error::ServoError;
pub use outcome::Outcome;
pub use identified::Identified;
pub use joint::ServoJoint;
pub use settings::Settings;

/// Whether all drives of an arm are position servos.
pub fn is_servo_arm(arm: &files::ArmFile) -> bool {
    let is_servo = |joint: &files::ArmJoint| {
        let kind = joint.drive.as_ref().map(|drive| drive.kind);
        kind == Some(files::arm_file::DriveKind::PositionServo)
    };
    !arm.joints.is_empty() && arm.joints.iter().all(is_servo)
}
