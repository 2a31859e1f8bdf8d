//! The RRR robot's model, shared by firmware, simulator and estimators.
//!
//! Everything here is a pure function of its arguments: no allocation, no `std`,
//! no `unsafe`, generic over `f32` (the board) and `f64` (the host). Units are SI
//! and stand in the names. Equation numbers are those of Kostić, Hensen, de Jager
//! and Steinbuch, *Modeling and Identification of an RRR-robot*.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`dynamics`] | mass matrix, Coriolis, gravity, inverse and forward dynamics, eq. (1) |
//! | [`regressor`] | the 3x16 matrix of eq. (5) |
//! | [`friction`], [`friction_parameters`] | LuGre friction and its exact step, eq. (9)-(10); its parameters as a list |
//! | [`effects`] | effects that eq. (1) and (9) lack, and their inverses |
//! | [`base`], [`geometry`], [`links`] | the 16 base parameters of eq. (4), and their computation from link masses |
//! | [`robot`], [`pendulum`] | a complete rig: three joints, or the one joint of eq. (11) |
//! | [`reference_robot`] | the numbers printed in the paper |
//! | [`mechanism`], [`chain`] | the interface of all arms; serial chains of any joints, recursively |
//! | [`dual`] | numbers that carry their derivatives, for exact slopes of all of these |
//!
//! The voltages that hold the reference robot's arm level, and the acceleration with
//! which it falls without them:
//!
//! ```
//! use model::{Posture, reference_robot::reference_robot};
//!
//! let robot = reference_robot::<f64>();
//! let (level, still) = (Posture::new(0.0, 0.0), [0.0; 3]);
//!
//! let torque_nm = level.inverse_dynamics(&robot.base, &robot.geometry, &still, &still);
//! let voltage_v = robot.torque_to_voltage(&torque_nm);
//! assert!((voltage_v[1] - 2.897).abs() < 1e-3);
//!
//! let fall = level.forward_dynamics(&robot.base, &robot.geometry, &still, &still);
//! assert!(fall[1] < -20.0);
//! ```
#![no_std]
#![forbid(unsafe_code)]

pub mod base;
mod base_check;
pub mod chain;
pub mod dual;
pub mod dynamics;
pub mod effects;
pub mod friction;
pub mod friction_parameters;
pub mod geometry;
pub mod links;
pub mod mechanism;
pub mod parameter;
pub mod pendulum;
pub mod real;
pub mod reference_robot;
pub mod regressor;
pub mod robot;
pub mod trigonometry;
pub mod vector;

pub use base::BaseParameters;
pub use dual::Dual;
pub use dynamics::Posture;
pub use friction::{Friction, FrictionState};
pub use geometry::{Geometry, HANGING_RAD};
pub use parameter::ParameterError;
pub use pendulum::Pendulum;
pub use real::Real;
pub use robot::Robot;
