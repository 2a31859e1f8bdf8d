//! Least squares, linear and not, with covariances.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`linear`] | weighted linear least squares and the condition number of eq. (14) |
//! | [`nonlinear`] | Levenberg-Marquardt with Jacobians by differences |
//! | [`autocorrelation`] | covariances that hold for residuals that are not white |

pub mod autocorrelation;
pub mod linear;
pub mod nonlinear;

pub use linear::{LinearFit, LinearProblem};
pub use nonlinear::{NonlinearFit, NonlinearSettings, minimise};
