//! Filtered, whitened rows, and the noise in them.

pub mod evidence;
pub mod misfit;
pub mod noise;
pub mod row_filter;
