//! What a joint does beyond the model, and how the command makes up for it.
//!
//! ```text
//! u = f1^-1( ... fn^-1( w - a ) )
//! ```
//!
//! w is the voltage that the control law wants at the motor, a what the motor finds added
//! to its own (cogging, cables, drag), f1 to fn what happens to the command on its way
//! there (offset, dead zone, ripple, torque constant), in the order of the list.
//! Friction that varies is fed forward as it varies. All of it is taken at the wanted
//! motion, as the model is. The mathematics is that of [`model::effects`].

mod apply;
mod check;
mod parameters;

pub(crate) use apply::Moving;
pub use parameters::{
    Compensations, FedForward, MOST_FED_FORWARD, MOST_UNDONE, Outside, TurnWave, Undone,
};
