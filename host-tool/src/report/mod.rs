//! Pages with pictures, each a single file.

pub mod chart;
pub mod diagnosis_page;
pub mod identification_page;
pub mod identification_summary;
pub mod one_joint_page;
pub mod page;
pub mod step_page;
mod thinning;
pub mod tracking_page;
pub mod validation_page;

pub use chart::{Axis, Chart, Series, Stroke};
pub use page::Page;
