//! Effect `table`: a curve over one axis that is added to the voltage of a joint.
//!
//! It is no cause. It is what remains once the causes are named, in a form that simulator and
//! board can play; so it is not among the effects of [`Catalogue::iter`](crate::effects::Catalogue::iter).
//!
//! | module | what it holds |
//! | --- | --- |
//! | `axis`, `board_axis` | over what the curve lies: [`TableAxis`], and whether the board plays that |
//! | `curve` | the curve: [`Table`] |
//! | `coarsened` | the curve with fewer knots |
//! | `acting` | what it does to the simulated robot |
//! | `in_file`, `names` | the curve as an `[[effect]]` of a model file |

mod acting;
mod axis;
mod board_axis;
mod coarsened;
mod curve;
mod in_file;
mod names;

pub use axis::TableAxis;
pub use board_axis::board_axis;
pub use curve::{FEWEST_TABLE_KNOTS, MAX_TABLE_KNOTS, Table};
pub use names::{AXIS, NAME};
