//! What stands behind the commands of a rig: joints with drives and friction, and the rigid body
//! that they move.
//!
//! | module | what it holds |
//! | --- | --- |
//! | `plant` | the whole: [`Plant`] |
//! | `body` | the rigid body, in closed form or as a chain: [`Body`] |
//! | `linked` | a chain by the coordinates in which it is refitted: [`LinkedBody`] |
//! | `of_arm` | the plant that a file of format 2 describes |
//! | `gear` | how often shafts turn per turn of their joint: [`Gear`] |
//! | `units` | in which units a joint moves and is commanded: [`JointUnits`] |

mod body;
mod gear;
mod linked;
mod of_arm;
#[allow(clippy::module_inception)]
mod plant;
mod units;

pub use body::Body;
pub use gear::Gear;
pub use linked::{Directions, LinkedBody};
pub use of_arm::{PlantError, torque_constants};
pub use plant::Plant;
pub use units::JointUnits;
