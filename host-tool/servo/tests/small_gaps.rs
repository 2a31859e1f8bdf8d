//! What leaves hardly more than an encoder's step, what turns all beyond a joint, and loads far from the hand.

use diagnosis::{Cause, Value};
use recordings::ArmCampaign;
use servo::prepared::{Prepared, joints};
use servo::recorded::{Recording, Truth, record};
use servo::report::report;
use servo::synthetic::{links_of, six_axes};
use servo::whole_effect::Whole;
use servo::{Outcome, ServoJoint, Settings};

/// Six motions to fit to and three held out, as blind trials have them.
fn recording() -> Recording {
    Recording { length_s: 30.0, logs: [6, 3], ..Recording::default() }
}

/// Logs of an arm of six servos of which one (from 1) is another than in the model.
fn changed(joint: usize, change: impl Fn(ServoJoint) -> ServoJoint) -> ArmCampaign {
    let file = six_axes(61);
    let mut servos = joints(&file).unwrap();
    servos[joint - 1] = change(servos[joint - 1]);
    record(&file, &Truth::of(links_of(&file), servos), &recording(), 61)
}

fn causes(campaign: &ArmCampaign) -> Vec<Cause> {
    report(&Outcome::of(campaign, &Settings::default(), &|_| ()).unwrap()).causes
}

fn names(causes: &[Cause]) -> Vec<(&str, u8)> {
    causes.iter().map(|cause| (cause.effect.as_str(), cause.joint)).collect()
}

fn number(cause: &Cause, name: &str) -> f64 {
    match &cause.parameters[name] {
        Value::Number(value) => *value,
        Value::Vector(values) => values[0],
    }
}

#[test]
fn a_refitted_arm_leaves_hardly_more_than_its_encoders_do() {
    let prepared = Prepared::of(&changed(1, |joint| joint), &Settings::default()).unwrap();
    for base in &prepared.bases {
        // A step of 12 bits, rounded, is 0.44 mrad; measured accelerations alone left 3 mrad.
        assert!(base.fitted.rms() < 0.8e-3, "{}", base.fitted.rms());
    }
}

#[test]
fn an_encoder_offset_is_named_on_its_own_joint_alone() {
    let found = causes(&changed(2, |joint| ServoJoint { encoder_offset: 0.06, ..joint }));
    assert_eq!(names(&found), [("encoder_offset", 2)]);
    assert!((number(&found[0], "offset_rad") - 0.06).abs() < 3e-3, "{:?}", found[0].parameters);
}

#[test]
fn a_delay_that_hardly_exceeds_the_rows_own_timing_is_named() {
    // Positions are read 6 ms after goals.
    let found = causes(&changed(6, |joint| ServoJoint { read_after_s: -0.0087, ..joint }));
    assert_eq!(names(&found), [("delay", 6)]);
}

#[test]
fn drag_of_air_is_found_as_degressive_friction_is() {
    for drag in [0.008, -0.02] {
        let found = causes(&changed(1, |joint| ServoJoint { drag, ..joint }));
        assert_eq!(names(&found), [("quadratic_drag", 1)], "{drag}");
        let value = number(&found[0], "coefficient_V_s2_per_rad2");
        assert!((value - drag).abs() < 0.2 * drag.abs(), "{value}");
    }
}

#[test]
fn a_weak_cable_is_told_from_slow_cogging() {
    let found = causes(&changed(1, |joint| ServoJoint { spring: 0.03, spring_rest: 0.8, ..joint }));
    assert_eq!(names(&found), [("cable_spring", 1)]);
}

#[test]
fn load_friction_of_a_joint_without_gravity_shows_by_what_the_others_ask() {
    let found = causes(&changed(1, |joint| ServoJoint { joint_load_friction: 1.0, ..joint }));
    assert_eq!(names(&found), [("load_friction", 1)]);
}

#[test]
fn a_load_far_from_the_hand_is_found_where_it_is() {
    let file = six_axes(62);
    let load = [0.15, -0.2, 0.05, 0.1];
    let links = Whole::Payload.links(&links_of(&file), &load);
    let truth = Truth::of(links, joints(&file).unwrap());
    let found = causes(&record(&file, &truth, &recording(), 62));
    assert_eq!(names(&found), [("payload", 0)]);
    assert!((number(&found[0], "mass_kg") - load[0]).abs() < 0.05 * load[0], "{:?}", found[0]);
    let Value::Vector(place) = &found[0].parameters["com_m"] else { panic!("a place") };
    for (found, truth) in place.iter().zip(&load[1..]) {
        assert!((found - truth).abs() < 0.02, "{place:?}");
    }
}
