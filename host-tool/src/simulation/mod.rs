//! The simulated robot, and experiments recorded with it.

pub mod designed_excitation;
pub mod plan;
pub mod recipe;
pub mod recording;
pub mod rig;
pub mod robot;
pub mod sensor;
pub mod tracking;
pub mod transmission;

pub use plan::Plan;
pub use recipe::Recipe;
pub use recording::{Recording, record, record_robot, start_of};
pub use rig::Rig;
pub use robot::{Settings, SimulatedRobot};
