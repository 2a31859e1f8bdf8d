//! Pages with pictures, each a single file.

#![forbid(unsafe_code)]

pub mod axis;
pub mod bar_table;
pub mod chart;
pub mod diagnosis_page;
pub mod heat_map;
pub mod identification_page;
pub mod identification_summary;
pub mod one_joint_page;
pub mod page;
mod provenance;
pub mod series;
pub mod servo_page;
pub mod share_bars;
pub mod step_page;
mod svg;
mod thinning;
pub mod tracking_page;
pub mod validation_page;
mod zoom;

pub use axis::Axis;
pub use bar_table::{BarRow, BarTable};
pub use chart::Chart;
pub use heat_map::HeatMap;
pub use page::Page;
pub use provenance::Provenance;
pub use series::{Series, Stroke};
pub use share_bars::{ShareBars, ShareRow};
