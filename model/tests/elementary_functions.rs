//! The `f32` functions that the model uses, against `f64`: the errors that [`Real`]
//! states. Those of the sines are tested beside them, in `trigonometry`.

mod common;

use common::largest;
use model::Real;

fn between(low: f32, high: f32) -> impl Iterator<Item = f32> {
    const POINTS: i32 = 1_000_000;
    (0..=POINTS).map(move |i| low + (high - low) * (i as f32 / POINTS as f32))
}

fn largest_relative_error(
    points: impl Iterator<Item = f32>,
    single: fn(f32) -> f32,
    double: fn(f64) -> f64,
) -> f64 {
    largest(points.map(|x| {
        let exact = double(f64::from(x));
        if exact == 0.0 { 0.0 } else { (f64::from(single(x)) - exact) / exact }
    }))
}

/// Asserts that an error is below, and not far below, the one documented.
fn assert_documented(error: f64, documented: f64) {
    assert!(error < documented && error > 0.7 * documented, "{error:e}, not {documented:e}");
}

#[test]
fn exponential() {
    let error = largest_relative_error(between(-80.0, 0.0), Real::exp, Real::exp);
    assert_documented(error, 7.2e-8);
}

#[test]
fn exponential_less_one() {
    let error = largest_relative_error(between(-60.0, 0.0), Real::exp_m1, Real::exp_m1);
    assert_documented(error, 7.2e-8);
    let small = largest_relative_error(between(-1e-3, 0.0), Real::exp_m1, Real::exp_m1);
    assert_documented(small, 7.2e-8);
}

#[test]
fn square_root_is_rounded_correctly() {
    assert!(between(0.0, 100.0).all(|x| Real::sqrt(x) == f64::from(x).sqrt() as f32));
}
