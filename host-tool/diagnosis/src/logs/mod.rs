//! The rig and its logs.

pub mod arm_friction;
pub mod arm_prior;
pub mod arm_subject;
pub mod base_prior;
pub mod bristle_path;
pub mod checks;
pub mod derived;
pub mod encoder_step;
pub mod even_clock;
pub mod intervals;
pub mod joint_dynamics;
pub mod kinematics;
pub mod last;
pub mod loads;
pub mod lost_samples;
pub mod recorded;
pub mod robot_subject;
pub mod sampling_jitter;
pub mod stamps;
pub mod stretch;
pub mod subject;
pub mod torque_slopes;
pub mod usable;
