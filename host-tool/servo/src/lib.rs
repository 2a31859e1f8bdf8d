//! Arms of position servos: simulated from their goals, refitted and diagnosed on motion.
//!
//! A position servo makes u = K (goal - q) - D qd itself, so its log holds goals and positions and
//! no command. What a model leaves is therefore a distance of positions: measured ones and those
//! that the model, simulated without feedback from the recorded goals, takes over whole logs.
//!
//! | module | what it holds, in the order in which data flow |
//! | --- | --- |
//! | [`settings`] | every choice with its reason |
//! | [`joint`], [`over_speed`], [`step`] | a joint under its servo, friction over speed by a table, and one step, friction as a set-valued law |
//! | [`record`], [`motion`], [`pieces`] | logs as stretches; smoothed velocity; pieces to leave out |
//! | [`moves`], [`along`], [`along_row`], [`judged`] | the motion it goes along, and what the rigid body asks of each joint along a log |
//! | [`replay`], [`arm_replay`] | one joint simulated while the others move as measured; the whole arm |
//! | [`fit`], [`base`] | parameters fitted to whole logs; those that are fitted before any effect |
//! | [`contact`], [`goal_clip`], [`prepared`] | seconds that are no free motion, found and cut |
//! | [`candidates`], [`cogging_orders`], [`cross`], [`joint_model`], [`selection`] | effects on one joint |
//! | [`pooled`], [`common_fit`] | servos of one type, load friction in common |
//! | [`whole_effect`], [`whole_fit`], [`whole_step`], [`whole_normal`], [`whole_cause`] | a payload, a force, a base that leans |
//! | [`beside_whole`], `open_friction` | that and the joints' friction, each as the other leaves it |
//! | [`confirm`], [`verdict`], [`joint_effects`], [`outcome`] | what stands on logs that chose nothing |
//! | [`effect_table`], [`whole_table`], [`model_file`], [`identified`] | what goes into model files |
//! | [`report`] and those behind it | `report.json` |
//! | [`simulated`], [`recorded`], [`goals`] | an arm with hidden effects, recorded |
//! | [`synthetic`] | servo arms for tests and trials |
#![forbid(unsafe_code)]

pub mod along;
pub mod along_row;
pub mod arm_replay;
pub mod base;
pub mod beside_whole;
pub mod candidates;
pub mod cogging_orders;
pub mod common_fit;
pub mod confirm;
pub mod contact;
pub mod cross;
pub mod effect_table;
pub mod error;
mod evidence;
pub mod fit;
pub mod goal_clip;
pub mod goals;
pub mod identified;
pub mod joint;
pub mod joint_effects;
pub mod joint_model;
pub mod judged;
pub mod model_file;
pub mod motion;
pub mod moves;
mod open_friction;
pub mod outcome;
pub mod over_speed;
pub mod pieces;
pub mod pooled;
pub mod prepared;
mod ranking;
pub mod record;
pub mod recorded;
pub mod replay;
pub mod report;
pub mod report_changes;
pub mod report_gap;
pub mod report_intervals;
pub mod report_places;
pub mod report_remarks;
pub mod report_words;
mod screen;
pub mod selection;
pub mod settings;
pub mod simulated;
pub mod spread;
pub mod step;
pub mod synthetic;
mod turned;
pub mod verdict;
pub mod whole_cause;
pub mod whole_effect;
pub mod whole_fit;
pub mod whole_normal;
pub mod whole_step;
pub mod whole_table;

pub use error::ServoError;
pub use identified::Identified;
pub use joint::ServoJoint;
pub use outcome::Outcome;
pub use settings::Settings;

/// Whether all drives of an arm are position servos.
pub fn is_servo_arm(arm: &files::ArmFile) -> bool {
    let is_servo = |joint: &files::ArmJoint| {
        let kind = joint.drive.as_ref().map(|drive| drive.kind);
        kind == Some(files::arm_file::DriveKind::PositionServo)
    };
    !arm.joints.is_empty() && arm.joints.iter().all(is_servo)
}
