//! Loads on a pendulum whose friction grows with the motor's torque, is degressive, and has another level at
//! rest than in motion: each of these looks like a load.

use diagnosis::{Cause, Value};
use servo::prepared::joints;
use servo::recorded::{Recording, Truth, record};
use servo::report::report;
use servo::synthetic::{links_of, pendulum};
use servo::{Outcome, ServoJoint, Settings};

/// What is named on a pendulum of 0.35 kg at 0.16 m, whose mass is this much more than its model's.
fn causes(added_kg: f64, seed: u64) -> Vec<Cause> {
    let truth = pendulum(seed, 0.35 + added_kg, 0.16);
    let rub = |joint: ServoJoint| ServoJoint {
        coulomb: 0.26,
        viscous: 1.1,
        stribeck: -0.08,
        stribeck_velocity: 0.3,
        motor_load_friction: 0.2,
        drag: -0.02,
        ..joint
    };
    let servos = joints(&truth).unwrap().into_iter().map(rub).collect();
    let recording =
        Recording { length_s: 30.0, logs: [6, 3], swing_rad: 1.2, ..Recording::default() };
    let mut campaign = record(&truth, &Truth::of(links_of(&truth), servos), &recording, seed);
    campaign.arm = pendulum(seed, 0.35, 0.16);
    report(&Outcome::of(&campaign, &Settings::default(), &|_| ()).unwrap()).causes
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
    let found = causes(0.0, 11);
    assert!(found.iter().all(|cause| cause.joint != 0), "{found:?}");
}

#[test]
fn a_mass_that_was_exchanged_is_told_within_a_tenth_although_friction_looks_like_one() {
    let found = payload(&causes(0.2, 13)).expect("a load that is named");
    assert!((found - 0.2).abs() < 0.02, "{found}");
}
