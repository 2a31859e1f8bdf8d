//! Loads on a pendulum whose friction grows with the motor's torque, is degressive, has another level at rest than in
//! motion, or is of no formula: each of these looks like a load.

use diagnosis::{Cause, Value};
use servo::over_speed::{OverSpeed, SPEEDS};
use servo::prepared::joints;
use servo::recorded::{Recording, Truth, record};
use servo::report::report;
use servo::synthetic::{links_of, pendulum};
use servo::{Outcome, ServoJoint, Settings};

/// What is named on a pendulum of 0.35 kg at 0.16 m that rubs so, whose mass is this much more than its model's.
fn causes(added_kg: f64, seed: u64, rub: fn(ServoJoint) -> ServoJoint) -> Vec<Cause> {
    let truth = pendulum(seed, 0.35 + added_kg, 0.16);
    let servos = joints(&truth).unwrap().into_iter().map(rub).collect();
    let recording =
        Recording { length_s: 30.0, logs: [6, 3], swing_rad: 1.2, ..Recording::default() };
    let mut campaign = record(&truth, &Truth::of(links_of(&truth), servos), &recording, seed);
    campaign.arm = pendulum(seed, 0.35, 0.16);
    report(&Outcome::of(&campaign, &Settings::default(), &|_| ()).unwrap()).causes
}

/// Friction by the catalogue's formulas.
fn degressive(joint: ServoJoint) -> ServoJoint {
    ServoJoint {
        coulomb: 0.26,
        viscous: 1.1,
        stribeck: -0.08,
        stribeck_velocity: 0.3,
        motor_load_friction: 0.2,
        drag: -0.02,
        ..joint
    }
}

/// Viscous friction by the 0.8th power of the speed, straight between seven speeds up to 10 rad/s, with a part of the
/// motor's torque.
fn of_a_power(joint: ServoJoint) -> ServoJoint {
    let (top, viscous) = (10.0, 0.8);
    let more = SPEEDS.map(|part| 1.2 * (part * top).powf(0.8) - viscous * part * top);
    let over_speed = OverSpeed { top, more };
    ServoJoint { coulomb: 0.2, viscous, over_speed, motor_load_friction: 0.15, ..joint }
}

fn payload(causes: &[Cause]) -> Option<f64> {
    let cause = causes.iter().find(|cause| cause.effect == "payload")?;
    match cause.parameters["mass_kg"] {
        Value::Number(mass) => Some(mass),
        Value::Vector(_) => None,
    }
}

#[test]
fn friction_is_not_named_as_a_load() {
    for (seed, rub) in
        [(11, degressive as fn(ServoJoint) -> ServoJoint), (12, of_a_power), (14, |joint| joint)]
    {
        let found = causes(0.0, seed, rub);
        assert!(found.iter().all(|cause| cause.joint != 0), "{seed}: {found:?}");
    }
}

#[test]
fn a_mass_that_was_exchanged_is_told_within_a_tenth_although_friction_looks_like_one() {
    let found = payload(&causes(0.2, 13, degressive)).expect("a load that is named");
    assert!((found - 0.2).abs() < 0.02, "{found}");
}

#[test]
fn a_mass_is_told_within_a_tenth_although_friction_is_of_no_formula() {
    for (added_kg, seed) in [(0.2, 17), (-0.1, 18)] {
        let found = payload(&causes(added_kg, seed, of_a_power)).expect("a load that is named");
        assert!((found - added_kg).abs() < 0.1 * added_kg.abs(), "{added_kg}: {found}");
    }
}

#[test]
fn a_mass_that_its_friction_hides_is_found() {
    let found = payload(&causes(-0.05, 24, of_a_power)).expect("a load that is named");
    assert!((found + 0.05).abs() < 0.01, "{found}");
}
