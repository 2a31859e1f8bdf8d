//! The simulated robot, the control firmware around it, and experiments recorded with both.
//!
//! The reference robot, let go with its arm level, falls for a second without a command:
//!
//! ```
//! use model::reference_robot::reference_robot;
//! use simulation::{Settings, SimulatedRobot};
//!
//! let settings = Settings { noise_v: 0.0, ..Settings::default() };
//! let mut robot = SimulatedRobot::at_rest(reference_robot(), [0.0; 3], &settings);
//! for _ in 0..1000 {
//!     robot.advance(&[0.0; 3]);
//! }
//! assert!(robot.q_rad()[1] < -1.0);
//! ```
#![forbid(unsafe_code)]

pub mod arm;
pub mod arm_recording;
pub mod board;
pub mod friction_law;
mod leapfrog;
pub mod plant;
pub mod recording;
pub mod robot;
pub mod sensor;
mod settings;
pub mod simulated_board;

pub use arm_recording::{ArmMotion, record_arm};
pub use friction_law::FrictionLaw;
pub use plant::SimulatedPlant;
pub use recording::{Recording, record, record_robot, record_sampled, start_of};
pub use robot::SimulatedRobot;
pub use settings::Settings;
