//! Pages with pictures, each a single file.

pub mod chart;
pub mod page;
mod thinning;
pub mod tracking_page;

pub use chart::{Axis, Chart, Series, Stroke};
pub use page::Page;
