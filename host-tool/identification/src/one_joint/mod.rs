//! What the steps on one joint share, and rigs that have but one.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`motion`] | motion and command, smoothed alike and differentiated |
//! | [`reconstruction`] | motion from encoder and command together, without a friction model |
//! | [`rows`] | a log laid out for the fit |
//! | [`grey_box`] | the command explained from the motion by LuGre friction and linear terms |
//! | [`start`] | where that search begins |
//! | [`tick`] | one tick of a joint with its slopes |
//! | [`pendulum`] | rigs of one joint with a coarse encoder |
//! | [`samples`] | a log for the filters |
//! | [`innovations`] | how well parameters predict the encoder, tick by tick |
//! | [`sandwich`] | standard errors from blocks of data |

pub mod grey_box;
pub mod innovations;
pub mod motion;
pub mod pendulum;
pub mod reconstruction;
pub mod rows;
pub mod samples;
pub mod sandwich;
pub mod start;
pub mod tick;
