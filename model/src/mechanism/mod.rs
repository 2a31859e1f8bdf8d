//! What identification, diagnosis, simulation and design need of an arm, whatever its joints.
//!
//! | file | what it holds |
//! | --- | --- |
//! | `interface.rs` | the trait [`Mechanism`] |
//! | `joint_kind.rs` | revolute or prismatic |
//! | `parameter_name.rs` | the names of the parameters in which a regressor is linear |
//! | `rrr.rs` | the robot of MODEL.md in closed form |
//!
//! The other implementation is [`crate::chain::SerialChain`].

mod interface;
mod joint_kind;
mod parameter_name;
mod rrr;

pub use interface::Mechanism;
pub use joint_kind::JointKind;
pub use parameter_name::ParameterName;
pub use rrr::Rrr;
