//! Filtered, whitened rows, and the noise in them.

pub mod evidence;
mod floors;
pub mod misfit;
mod misfit_piece;
pub mod noise;
mod places;
pub mod row_filter;
mod speed_classes;
