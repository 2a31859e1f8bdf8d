//! Effects that the model does not hold: what they are, and the catalogue of them.
//!
//! Each has a file in `catalogue/`, which says what the effect is, in words and as an equation,
//! which parameters it has, what it does to the simulated robot, how it is searched for and how
//! the board compensates for it. Adding one is adding a file and its line in `catalogue/mod.rs`.
//!
//! u is the command, q the joint as its encoder sees it, n a harmonic per turn.
//!
//! | module | what it holds |
//! | --- | --- |
//! | `definition` | all that is known of an effect: [`Definition`] |
//! | `parameter` | its parameters as typed kinds: [`Parameter`], [`Kind`] |
//! | `search`, `sizes` | where a search begins, and what a blind trial draws |
//! | `confusion`, `compensation` | what it is taken for, and what the board compensates for |
//! | `effect` | what it does: [`Effect`] |
//! | `wave` | a wave over the turn of a shaft: [`Wave`] |
//! | `catalogue` | the effects: [`Catalogue`] |
//! | `table` | a curve over one axis, which is no cause: [`Table`] |
//! | `parse` | effects from tables of a model file and from the command line |
//! | `documentation` | `docs/effects.md` |

mod catalogue;
mod compensation;
mod confusion;
mod definition;
pub mod documentation;
mod effect;
mod error;
mod parameter;
mod parse;
mod random;
mod search;
mod sizes;
mod table;
mod transmission;
mod wave;

pub use catalogue::Catalogue;
pub use compensation::{ArmLoad, Compensation, turn_wave};
pub use confusion::{Confused, Confusion};
pub use definition::{Definition, Touches};
pub use effect::{Effect, JointState};
pub use error::EffectError;
pub use parameter::{Kind, Parameter};
pub use parse::table_from_text;
pub use random::Random;
pub use search::{Carrier, Search, Size, Typical};
pub use sizes::{DrawContext, harmonic};
pub use table::{FEWEST_TABLE_KNOTS, MAX_TABLE_KNOTS, Table, TableAxis, board_axis};
pub use transmission::Transmission;
use wave::Wave;
pub use wave::felt_by_second_differences;
