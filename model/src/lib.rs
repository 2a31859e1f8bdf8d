//! The RRR robot's mathematics, once, for firmware, simulator and estimators.
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
//! | [`friction`] | LuGre friction and its exact step, eq. (9)-(10) |
//! | [`base`], [`geometry`], [`links`] | the 16 base parameters and where they come from |
//! | [`robot`], [`pendulum`] | a whole rig: three joints, or the one joint of eq. (11) |
//! | [`reference_robot`] | the numbers printed in the paper |
#![no_std]
#![forbid(unsafe_code)]

pub mod base;
pub mod dynamics;
pub mod friction;
pub mod geometry;
pub mod links;
pub mod parameter;
pub mod pendulum;
pub mod real;
pub mod reference_robot;
pub mod regressor;
pub mod robot;
pub mod trigonometry;
pub mod vector;

pub use base::BaseParameters;
pub use dynamics::Posture;
pub use friction::{Friction, FrictionState};
pub use geometry::Geometry;
pub use parameter::ParameterError;
pub use pendulum::Pendulum;
pub use real::Real;
pub use robot::Robot;
