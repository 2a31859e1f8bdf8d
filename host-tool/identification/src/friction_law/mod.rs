//! Which law of friction a joint's data carry: static friction, eq. (10), or LuGre's bristles, eq. (9).
//!
//! A joint whose friction follows its velocity alone, or gives in to any force, has no bristles.
//! LuGre's law fitted to it ends at a stiffness that means nothing: millions where friction jumps,
//! a few volts per radian where it creeps. Both laws are therefore fitted, and each predicts what
//! it was not fitted to.
//!
//! # Evidence from sliding and reversals
//! The excitation is cut in halves; each law, with all parameters, is refined on one half and
//! reconstructs the command of the other. With S_b and L_b the squares that static friction and
//! LuGre's leave of block b, d_b = (S_b - L_b) / (S_b + L_b): a few large reversals do not decide
//! alone. Where bristles carry nothing, d_b is as often above zero as below, and
//! (Efron, J. Am. Stat. Assoc. 64, 1969) P(sum d_b > x sqrt(sum d_b^2)) <= exp(-x^2 / 2) whatever
//! the distribution of each. [`CERTAIN`] is the x at which this is 1 in 1000.
//!
//! # Evidence from pre-sliding
//! Bristles that reversals are too quick to show may show in the FRF, eq. (12): its sigma0 is then
//! [`CERTAIN`] standard errors above zero. A joint that creeps shows damping there and no stiffness.
//!
//! # Bounds
//! A stiffness beyond what encoder and FRF leave open is none that the data carry, however well it
//! fits: see `largest_stiffness`.
//!
//! Where nothing speaks for bristles the joint has static friction. The model's readers need
//! numbers all the same: see `stiffness`.
//!
//! | module | what it holds |
//! | --- | --- |
//! | `certainty` | when a figure is taken for certain |
//! | `choice` | **the law of each joint** |
//! | `evidence` | what each law leaves of what it was not fitted to |
//! | `halves` | logs cut in halves |
//! | `largest_stiffness` | the largest sigma0 that data can speak for |
//! | `law` | a law, and why it was taken |
//! | `static_friction` | static friction as the limit of stiff bristles |
//! | `stiffness` | how soft bristles may be before the data object |

mod certainty;
mod choice;
mod evidence;
mod halves;
mod largest_stiffness;
mod law;
mod static_friction;
mod stiffness;

pub use certainty::CERTAIN;
pub(crate) use certainty::stiffness_in_errors;
pub(crate) use choice::choose;
pub use evidence::Evidence;
pub use law::{FrictionLaw, Law};
pub(crate) use static_friction::{as_static, note_chosen_bristles};
