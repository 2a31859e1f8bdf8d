//! What can be wrong with a file, where it is, and what to do about it.

mod hint;
mod located;
mod place;
mod problem;

pub use located::{FileError, LocatedProblem};
pub use place::Place;
pub use problem::Problem;
