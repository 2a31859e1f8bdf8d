//! Filtered, whitened rows, and the noise in them.

pub mod evidence;
pub mod misfit;
mod misfit_piece;
pub mod noise;
pub mod row_filter;
mod speed_classes;
