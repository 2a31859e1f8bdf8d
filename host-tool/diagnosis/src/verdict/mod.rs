//! What the search amounts to.

pub mod detectable;
pub mod judgement;
pub mod misfit;
pub mod shrinkage;
