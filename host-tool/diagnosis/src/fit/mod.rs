//! A hypothesis linearised, fitted, and judged against the noise.

pub mod fit;
pub mod linearisation;
pub mod preparation;
pub mod rest;
pub mod slopes;
pub mod unknowns;
