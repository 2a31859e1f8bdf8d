//! What the steps on one joint share, and rigs that have but one.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`motion`] | motion and command, smoothed alike and differentiated |
//! | [`reconstruction`] | motion from encoder and command together, without a friction model |
//! | [`rows`] | a log laid out for the fit |
//! | [`grey_box`] | the command explained from the motion by LuGre friction and linear terms |
//! | [`start`] | where that search begins |
//! | [`pendulum`] | rigs of one joint with a coarse encoder |
//! | [`parameters`] | a joint's parameters as one list |
//! | [`friction_step`], [`dynamics`] | friction and motion over a step of time, with Jacobians |
//! | [`samples`], [`noise`] | a log and its noise for the filters |
//! | [`kalman_filter`], [`sensitivity`] | the filter with fixed parameters, its derivatives by them |
//! | [`innovations`], [`gauss_newton`] | how well parameters predict the encoder, and the equations of their likelihood |
//! | [`sandwich`] | standard errors from blocks of data |

pub mod dynamics;
pub mod friction_step;
pub mod gauss_newton;
pub mod grey_box;
pub mod innovations;
pub mod kalman_filter;
pub mod motion;
pub mod noise;
pub mod parameters;
pub mod pendulum;
pub mod reconstruction;
pub mod rows;
pub mod samples;
pub mod sandwich;
pub mod sensitivity;
pub mod start;
