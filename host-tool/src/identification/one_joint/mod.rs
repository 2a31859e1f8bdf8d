//! What the steps on one joint share, and rigs that have but one.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`motion`] | motion and command, smoothed alike and differentiated |
//! | [`grey_box`] | the command explained from the measured motion by LuGre friction and linear terms |
//! | [`sandwich`] | standard errors from blocks of data |

pub mod grey_box;
pub mod motion;
pub mod sandwich;
