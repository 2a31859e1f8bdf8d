//! What the search amounts to.

pub mod decision;
pub mod detectable;
pub mod misfit;
pub mod shrinkage;
