//! The paper's identification procedure, step by step, and past it.
//!
//! | module | step |
//! | --- | --- |
//! | [`arm`] | **arms of any kind**: links, rotors and friction from logs of any motion |
//! | [`ekf`] | friction, inertia and gravity of a joint by the augmented Kalman filter, eq. (11) |
//! | [`estimate`], [`friction_estimates`] | a value, and a joint's friction, with uncertainty |
//! | [`friction_law`] | static friction or bristles, whichever the data carry |
//! | [`one_joint`] | what the steps on one joint share, and rigs that have but one |
//! | [`static_friction`] | static friction from constant-velocity runs, eq. (10) |
//! | [`base_parameters`] | base parameters by least squares, eq. (13)-(16) |
//! | [`excitation_design`] | the motion that identifies best, section 4.2 |
//! | [`prediction`] | the motion that a model predicts from the commands, Fig. 5 |
//! | [`presliding`] | pre-sliding friction from the FRF, eq. (12) |
//! | [`procedure`] | **all steps together** |
//! | [`physical`] | rigid links that have the base parameters |
//! | [`refinement`] | friction and base parameters together |
//! | [`reconstruction`] | the command that a model needs for a motion, Fig. 8 and 10 |

#![forbid(unsafe_code)]

pub mod arm;
pub mod base_parameters;
pub mod ekf;
pub mod estimate;
pub mod excitation_design;
pub mod friction_estimates;
pub mod friction_law;
pub mod one_joint;
pub mod physical;
pub mod prediction;
pub mod presliding;
pub mod procedure;
pub mod reconstruction;
pub mod refinement;
pub mod static_friction;

pub use estimate::Estimate;
