//! `robot.toml` and `model.toml` of format 2: arms of any kind.
//!
//! | file | what it holds |
//! | --- | --- |
//! | `arm.rs` | what such a file says |
//! | `joint.rs`, `drive.rs` | what it says of a joint: geometry, link; drive, encoder, friction |
//! | `units.rs` | names of values by kind of joint and drive |
//! | `read.rs`, `read_joint.rs`, `read_drive.rs`, `standard_errors.rs` | from TOML |
//! | `urdf.rs`, `urdf_tree.rs` | geometry and inertias from a URDF |
//! | `write.rs` | to TOML |
//! | `convert.rs` | as the model's types |

mod arm;
mod convert;
mod drive;
mod joint;
mod read;
mod read_drive;
mod read_joint;
mod standard_errors;
mod units;
mod urdf;
mod urdf_tree;
mod write;

pub use arm::{ArmFile, BaseError};
pub use drive::{ArmFriction, Drive, DriveKind, Encoder, EncoderSide};
pub use joint::{ArmJoint, LinkTable};
