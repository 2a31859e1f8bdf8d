//! Parameters of a joint fitted to whole logs, without feedback.

mod normal;
mod problem;
mod search;
mod unknown;

pub use normal::{Normal, block_squares, errors, robust, squares};
pub use problem::Problem;
pub use search::{Fitted, fit, move_by};
pub use unknown::{Field, Unknown};
