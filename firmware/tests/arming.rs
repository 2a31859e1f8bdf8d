//! An arm is armed only where its estimate can be believed.
#![allow(missing_docs)]

#[allow(dead_code)]
mod common;

use common::played::{COUNTS_PER_RAD, play, quiet};
use common::supervised::{armed, disarmed, holding};
use firmware::supervisor::{Health, Implausible, Order, OrderError};
use firmware::{Mode, ParameterBlock};

/// Why a supervisor does not arm after these counts of joint 2.
fn refusal(block: ParameterBlock, counts: impl Fn(i32) -> i32, ticks: i32) -> Implausible {
    let mut supervisor = disarmed(block);
    assert!(play(&mut supervisor, quiet(|k| [0, counts(k), 0], ticks)).is_none());
    match supervisor.execute(Order::Arm) {
        Err(OrderError::Implausible { joint: 2, why }) => why,
        other => panic!("{other:?}"),
    }
}

#[test]
fn an_implausible_estimate_is_not_armed() {
    let block = || holding(Mode::Pd);
    let supervisor = &mut disarmed(block());
    supervisor.tick(&[0; 3], Health::default());
    let why = Implausible::NotSettled;
    assert_eq!(supervisor.execute(Order::Arm), Err(OrderError::Implausible { joint: 1, why }));
    // 0.1 rad/s are 10.4 counts a tick.
    assert_eq!(refusal(block(), |k| 10 * k, 500), Implausible::Moving);
    assert_eq!(refusal(block(), |k| if k < 480 { 0 } else { 40_000 }, 500), Implausible::Jumped);
    // So slow a filter does not follow within a window.
    let mut slow = block();
    slow.velocity_bandwidth_rad_per_s[1] = 5.0;
    let shaking = |k: i32| (3e3 * (0.02 * f64::from(k)).sin()) as i32;
    assert_eq!(refusal(slow, shaking, 480), Implausible::Disagrees);
    // At rest again, it is armed.
    let mut supervisor = disarmed(block());
    play(&mut supervisor, quiet(|k| [0, 10 * k.min(100), 0], 500));
    assert_eq!(supervisor.execute(Order::Arm), Ok(()));
}

#[test]
fn people_may_move_an_arm_that_is_not_armed() {
    let count = |k: i32| (0.5e-4 * f64::from(k * k) * COUNTS_PER_RAD) as i32;
    let ticks = || quiet(|k| [0, count(k.min(400)), 0], 500);
    assert!(play(&mut disarmed(holding(Mode::Pd)), ticks()).is_none());
    assert!(play(&mut armed(holding(Mode::Pd)), ticks()).is_some(), "but not an armed one");
}
