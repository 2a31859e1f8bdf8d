//! Serial chains of revolute and prismatic joints: recursive dynamics in spatial vectors.
//!
//! Equations and tables are those of Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008
//! (RBDA). Frames are those of URDF: the frame of link i lies in joint i and moves with the link;
//! at q = 0 it stands in the frame of link i - 1 as `origin` says.
//!
//! | file | what it holds | source |
//! | --- | --- | --- |
//! | `spatial.rs` | motion and force vectors, coordinate transforms | RBDA 2.2 to 2.9 |
//! | `body.rs` | a link's mass, first moment, inertia | RBDA 2.13 |
//! | `log_cholesky.rs` | bodies by ten numbers that may be anything | Rucker and Wensing 2022 |
//! | `articulated_body.rs` | an articulated body's 6 x 6 inertia | RBDA 7.1 |
//! | `joint.rs` | a joint: where it stands, its axis, its link, its rotor | RBDA 4.4 |
//! | `serial_chain.rs` | the chain itself | |
//! | `motion.rs` | velocities and accelerations of all links | RBDA eq. (5.7) to (5.9) |
//! | `rnea.rs` | inverse dynamics | RBDA Table 5.1 |
//! | `crba.rs` | mass matrix | RBDA Table 6.2 |
//! | `aba.rs` | forward dynamics | RBDA Table 7.1 |
//! | `regressor.rs` | regressor of all links in one pass | Atkeson, An and Hollerbach 1986 |
//! | `jacobian.rs` | pose and Jacobian of the tip | |
//! | `mechanism.rs` | the chain as a [`crate::mechanism::Mechanism`] | |

mod aba;
mod articulated_body;
mod body;
mod crba;
mod jacobian;
mod joint;
mod log_cholesky;
mod mechanism;
mod motion;
mod regressor;
mod rnea;
mod serial_chain;
mod spatial;

pub use body::{BODY_PARAMETERS, Body};
pub use joint::{Joint, rotation_of_rpy};
pub use regressor::{LINK_PARAMETERS, link_parameter_name};
pub use serial_chain::{MAX_JOINTS, SerialChain};
pub use spatial::{Force, Motion, Transform};
