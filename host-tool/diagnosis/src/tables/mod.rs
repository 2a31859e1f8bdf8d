//! Curves over one axis, for what no effect of the catalogue explains.
//!
//! A table is the most that anything along its axis could explain: an effect that reaches less than
//! nine tenths of it is not the cause. What remains once all causes are found becomes tables in the
//! amended model, so that simulator and board profit where no name is known.

pub mod ceiling;
pub mod knots;
pub mod remaining;
pub mod tone;
