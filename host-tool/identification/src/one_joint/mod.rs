//! What the steps on one joint share, and rigs that have but one.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`reconstruction`] | motion from encoder and command together, without a friction model |
//! | [`rows`], [`log_rows`] | the rows of a fit, and those of a log |
//! | [`grey_box`] | the command explained from the motion by LuGre friction and linear terms |
//! | [`bristles`], [`weak_priors`] | its friction under a jitter, and its priors |
//! | [`sliding`] | sliding friction alone, by linear least squares |
//! | [`pendulum`] | rigs of one joint with a coarse encoder |
//! | [`parameters`] | a joint's parameters as one list |
//! | [`friction_step`], [`dynamics`] | friction and motion over a step of time, with Jacobians |
//! | [`samples`], [`noise`] | a log and its noise for the filters |
//! | [`kalman_filter`], [`sensitivity`] | the filter with fixed parameters, its derivatives by them |
//! | [`innovations`], [`gauss_newton`] | how well parameters predict the encoder, and the equations of their likelihood |
//! | [`sandwich`] | standard errors from blocks of data |

pub mod bristles;
pub mod dynamics;
pub mod friction_step;
pub mod gauss_newton;
pub mod grey_box;
pub mod innovations;
pub mod kalman_filter;
pub mod log_rows;
pub mod noise;
pub mod parameters;
pub mod pendulum;
pub mod reconstruction;
pub mod rows;
pub mod samples;
pub mod sandwich;
pub mod sensitivity;
pub mod sliding;
pub mod weak_priors;
