//! The simulated robot, the control firmware around it, and experiments recorded with both.
#![forbid(unsafe_code)]

pub mod board;
mod leapfrog;
pub mod recording;
pub mod robot;
pub mod sensor;
mod settings;
pub mod simulated_board;

pub use recording::{Recording, record, record_robot, start_of};
pub use robot::SimulatedRobot;
pub use settings::Settings;
