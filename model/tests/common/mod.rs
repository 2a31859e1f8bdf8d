//! What several test files share.
#![allow(dead_code, reason = "each test file uses its own part")]

pub mod chains;
pub mod lugre;
pub mod newton_euler;
pub mod rigid_robot;

use proptest::test_runner::{Config, RngSeed};

/// A fixed seed: the errors measured here are stated in the documentation.
pub fn cases(cases: u32) -> Config {
    Config { cases, rng_seed: RngSeed::Fixed(1), failure_persistence: None, ..Config::default() }
}

/// The largest of some errors; a NaN counts as infinite.
pub fn largest(errors: impl IntoIterator<Item = f64>) -> f64 {
    errors.into_iter().fold(0.0, |worst, error| {
        if error.is_nan() { f64::INFINITY } else { worst.max(error.abs()) }
    })
}
