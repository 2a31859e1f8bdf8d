//! Synthetic residuals, one per axis.

use std::f64::consts::TAU;

use super::gap_by_axis;
use crate::criteria::AxisCriteria;
use crate::result::{Axis, GapShare};
use crate::synthetic::{At, logs};

fn first(residual_v: impl Fn(&At) -> f64) -> GapShare {
    let shares = gap_by_axis(&logs(residual_v), &AxisCriteria::default());
    let shown: Vec<_> =
        shares.iter().map(|p| (p.joint, p.axis, p.share, p.detail.clone())).collect();
    println!("{shown:?}");
    shares.into_iter().next().expect("a place")
}

fn assert_place(place: &GapShare, axis: Axis, least: f64, words: &str) {
    assert_eq!((place.joint, place.axis), (3, axis), "{place:?}");
    assert!(place.share > least && place.detail.contains(words), "{place:?}");
}

#[test]
fn cogging_is_an_order_over_position() {
    let place = first(|at| 0.11 * (8.0 * at.q + 0.9).sin());
    assert_place(&place, Axis::Position, 0.95, "order 8 per revolution, 0.11 V");
    let place = first(|at| 0.02 * (37.0 * at.q).sin() * at.qd.signum());
    assert_place(&place, Axis::Position, 0.9, "order 37 per revolution");
    assert!(place.detail.contains("turns with the direction"), "{place:?}");
}

#[test]
fn hum_is_a_line_in_time() {
    let place = first(|at| 0.05 * (TAU * 50.0 * at.t).sin());
    assert_place(&place, Axis::Frequency, 0.9, "a line at 50.0 Hz");
    let place = first(|at| 0.05 * (TAU * 3.0 * at.t).sin());
    assert_place(&place, Axis::Frequency, 0.9, "a line at 3.0 Hz");
}

#[test]
fn a_band_has_its_edges() {
    let place = first(|at| {
        (30..60).map(|f| 0.01 * (TAU * f64::from(f) * 1.013 * at.t + f64::from(f * f)).sin()).sum()
    });
    assert_place(&place, Axis::Frequency, 0.8, "");
}

#[test]
fn velocity_is_split_into_even_and_odd() {
    let place = first(|at| 0.04 * at.qd.abs());
    let words = "even in velocity: larger forwards than backwards, grows with |velocity|";
    assert_place(&place, Axis::Velocity, 0.95, words);
    let place = first(|at| 0.03 * at.qd * at.qd.abs());
    assert_place(&place, Axis::Velocity, 0.9, "grows with |velocity|");
    let place = first(|at| 0.06 * at.qd.signum());
    assert_place(&place, Axis::Velocity, 0.9, "the same at every speed");
}

#[test]
fn constants_trends_and_accelerations() {
    assert_place(&first(|_| 0.09), Axis::Offset, 0.95, "constant, ");
    let warming = |at: &At| -0.08 * (1.0 - (-at.t / 8.0).exp()) * at.qd.signum();
    let place = gap_by_axis(&logs(warming), &AxisCriteria::default())
        .into_iter()
        .find(|p| p.axis == Axis::Time)
        .unwrap();
    assert!(place.share > 0.1 && place.detail.contains("dry friction falls"), "{place:?}");
    let place = first(|at| 0.02 * at.qdd * at.qdd.abs().sqrt());
    assert_place(&place, Axis::Acceleration, 0.8, "");
}

#[test]
fn a_limit_of_the_command_is_found() {
    let place = first(|at| at.u.signum() * (at.u.abs() - 1.0).max(0.0));
    assert_place(&place, Axis::Command, 0.8, "only beyond |u| = ");
    let place = first(|at| 0.04 * at.u);
    assert_place(&place, Axis::Command, 0.9, "proportional to the command, +4.0 %");
}

#[test]
fn friction_under_load_lies_on_the_load() {
    let rubbing = |at: &At| 0.05 * at.load.abs() * at.qd.signum();
    let found = gap_by_axis(&logs(rubbing), &AxisCriteria::default());
    let place = found.iter().find(|p| p.axis == Axis::Load).expect("a load");
    assert!(place.share > 0.1 && place.detail.contains("friction"), "{found:?}");
}

#[test]
fn noise_has_no_place() {
    let found = gap_by_axis(&logs(|_| 0.0), &AxisCriteria::default());
    assert!(found.is_empty(), "{found:?}");
    assert!(gap_by_axis(&[], &AxisCriteria::default()).is_empty());
}

#[test]
fn two_places_share_the_gap() {
    let both = |at: &At| 0.05 * (8.0 * at.q).sin() + 0.05 * (TAU * 50.0 * at.t).sin();
    let found = gap_by_axis(&logs(both), &AxisCriteria::default());
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(found.iter().all(|place| (place.share - 0.5).abs() < 0.05), "{found:?}");
}

#[test]
fn it_takes_a_moment_only() {
    let logs = logs(|at| 0.04 * at.qd.abs() + 0.05 * (8.0 * at.q).sin());
    let started = std::time::Instant::now();
    gap_by_axis(&logs, &AxisCriteria::default());
    let elapsed_s = started.elapsed().as_secs_f64();
    println!("{elapsed_s} s");
    assert!(elapsed_s < 2.0, "{elapsed_s} s");
}
