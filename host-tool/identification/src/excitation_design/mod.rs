//! Design of the motion that identifies the base parameters best, section 4.2.
//!
//! Each joint moves by a five-term Fourier series about the posture in which the arm
//! hangs. A search finds the coefficients for which the condition number J_k of Phi,
//! eq. (14), is small, within the velocity limits of the joints and within what the
//! amplifiers can drive.
//!
//! J_k is taken of Phi exactly as eq. (14) writes it: rows divided by the torque
//! constants, columns neither scaled nor left out, so that it compares with the
//! paper's 8.06. It therefore depends on units: all columns are volts per kg m^2 or
//! volts per kg m, and the columns of gravity stand beside columns of accelerations and
//! products of velocities; on this robot they happen to be of the same size. A parameter that is
//! small, such as ia3, is found with the same absolute error as a large one: a small
//! J_k bounds errors in kg m^2, not in percent. J_k does not depend on the base
//! parameters; those enter through the voltage that the motion needs.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`settings`] | limits of the motion and effort of the search |
//! | [`series`] | the motion of all joints, sampled |
//! | [`condition`] | Phi and its condition number |
//! | [`demand`] | peaks of velocity and voltage |
//! | [`range`] | the joints' ranges |
//! | [`objective`] | from the searched vector to a motion, and what it costs |
//! | [`search`] | CMA-ES from several starts |

pub mod condition;
pub mod demand;
pub mod objective;
pub mod range;
pub mod search;
pub mod series;
pub mod settings;

pub use condition::condition_number;
pub use demand::Demand;
pub use range::Range;
pub use search::{Design, design};
pub use series::{Series, State};
pub use settings::{Effort, Limits, Settings};
