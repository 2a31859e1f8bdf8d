//! Compensation of effects that the rigid-body and friction model lacks.
//!
//! ```text
//! u = f1^-1( ... fn^-1( w - a ) )
//! ```
//!
//! w is the motor voltage that the control law computes, a the disturbance voltage of cogging,
//! cables, drag and tables (curves over position, velocity or load), f1 to fn the effects between command and motor (offset, dead zone, ripple,
//! torque constant), in the order of the list. Friction that varies is fed forward with its
//! variation. All of it is evaluated at the reference, as the model is. The mathematics is that
//! of [`model::effects`].

mod apply;
mod check;
pub mod limits;
mod parameters;
mod tables;

pub(crate) use apply::{InputInverses, JointMotion, less_tables};
pub use parameters::{
    AngularHarmonic, Compensations, ExternalLoad, Feedforward, InputInverse, MAX_FEEDFORWARD,
    MAX_INPUT_INVERSES,
};
pub use tables::{MAX_KNOTS, MAX_TABLES, Table, TableAxis};
