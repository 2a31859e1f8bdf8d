//! The step takes the velocity as constant over the tick: what that costs while the
//! velocity swings as 1 rad/s sin(2 pi 1 Hz t), against eq. (9) with tiny steps.
//!
//! The figures stand at [`FrictionState::step`] and in docs/model.md.

mod common;

use common::lugre::{integrate, joints, largest_deflection_rad};
use model::{Friction, FrictionState};

const TICK_S: f64 = 1e-3;
const TICKS: usize = 1500;

fn velocity(time_s: f64) -> f64 {
    (std::f64::consts::TAU * time_s).sin()
}

/// Largest errors of z, in parts of its range, and of the tick's mean voltage [V], if the
/// step takes the velocity at `sampled_at` of each tick (0 its start, 1 its end).
fn worst_errors(friction: &Friction<f64>, sampled_at: f64) -> [f64; 2] {
    let mut state = FrictionState { deflection_rad: 0.0 };
    let (mut exact_rad, mut worst) = (0.0, [0.0_f64; 2]);
    for tick in 0..TICKS {
        let start_s = tick as f64 * TICK_S;
        let (next, exact_v) =
            integrate(friction, |t| velocity(start_s + t), exact_rad, TICK_S, 500);
        exact_rad = next;
        let v = velocity(start_s + sampled_at * TICK_S);
        let mean_v = state.step(friction, v, TICK_S);
        let deflection = (state.deflection_rad - exact_rad) / largest_deflection_rad(friction);
        worst = [worst[0].max(deflection.abs()), worst[1].max((mean_v - exact_v).abs())];
    }
    worst
}

/// Of the three joints.
fn worst_of_joints(sampled_at: f64) -> [f64; 2] {
    let of_joints = joints().map(|friction| worst_errors(&friction, sampled_at));
    [0, 1].map(|part| of_joints.iter().fold(0.0, |worst, errors| errors[part].max(worst)))
}

#[test]
fn velocity_at_the_middle_of_the_tick_costs_a_millivolt() {
    let [deflection, voltage] = worst_of_joints(0.5);
    assert!(deflection < 7e-4, "{deflection:e} of the range");
    assert!(voltage < 1.1e-3, "{voltage:e} V");
    assert!(deflection > 6e-4 && voltage > 1.0e-3, "document {deflection:e}, {voltage:e} V");
}

/// Half a tick late: at the reversal the friction turns over half a tick late as well.
#[test]
fn velocity_at_the_start_of_the_tick_costs_forty_millivolts() {
    let [deflection, voltage] = worst_of_joints(0.0);
    assert!(deflection < 0.094, "{deflection:e} of the range");
    assert!(voltage < 0.043, "{voltage:e} V");
    assert!(deflection > 0.09 && voltage > 0.04, "document {deflection:e}, {voltage:e} V");
}
