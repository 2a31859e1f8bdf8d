//! Least squares, linear and not, with covariances.
