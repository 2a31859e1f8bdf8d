//! Effect `table`: a curve over one axis that is added to the voltage of a joint.
//!
//! It is no cause. It is what remains once the causes are named, in a form that simulator and
//! board can play; so it is not among the effects of [`Catalogue::iter`](crate::effects::Catalogue::iter).
//!
//! | module | what it holds |
//! | --- | --- |
//! | `axis` | over what the curve lies: [`TableAxis`] |
//! | `curve` | the curve: [`Table`] |
//! | `acting` | what it does to the simulated robot |
//! | `in_file`, `names` | the curve as an `[[effect]]` of a model file |

mod acting;
mod axis;
mod curve;
mod in_file;
mod names;

pub use axis::TableAxis;
pub use curve::{MAX_TABLE_KNOTS, Table};
pub use names::{AXIS, NAME};
