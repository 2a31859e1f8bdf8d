//! A clean robot whose model or logs are wrong in one thing is told that thing, and no cause.
#![allow(missing_docs)]

use std::cell::Cell;

use diagnosis::{Criteria, Report, Verdict, diagnose};
use recordings::Campaign;
use rig::effects::Catalogue;

#[path = "common/short_campaign.rs"]
mod short_campaign;
use short_campaign::short_campaign;

/// What is said of a clean robot's logs once something is wrong with them or with the model.
fn said_of(spoil: impl Fn(&mut Campaign)) -> Report {
    said_with_rounds(spoil).0
}

/// The same, with the rounds of the search for causes.
fn said_with_rounds(spoil: impl Fn(&mut Campaign)) -> (Report, usize) {
    let mut campaign = short_campaign(Vec::new);
    spoil(&mut campaign);
    let rounds = Cell::new(0);
    let progress = |stage: &str| rounds.set(rounds.get() + usize::from(stage.contains("round")));
    let (catalogue, criteria) = (Catalogue::standard(), Criteria::default());
    let report = diagnose(&campaign, &catalogue, &criteria, &progress).unwrap().report;
    (report, rounds.get())
}

fn assert_fault(report: &Report, words: &str) {
    let fault = report.model_fault.as_ref().expect(words);
    assert!(fault.what.contains(words), "{fault:?}");
    assert!(fault.explained > 0.9, "{fault:?}");
    assert_eq!(report.verdict, Verdict::Unknown);
    assert!(report.causes.is_empty(), "{:?}", report.causes);
}

fn turned(signal: &mut [f64]) {
    signal.iter_mut().for_each(|value| *value = -*value);
}

#[test]
fn nothing_wrong_is_no_fault() {
    let report = said_of(|_| ());
    assert_eq!((report.verdict, report.model_fault), (Verdict::None, None));
}

#[test]
fn a_joint_that_counts_the_other_way() {
    let report = said_of(|campaign| {
        for trace in &mut campaign.traces {
            turned(&mut trace.joints[0].q_rad);
            turned(&mut trace.joints[0].command_v);
        }
    });
    assert_fault(&report, "joint 1 counts and is driven the other way round");
}

/// The search ends once two causes leave more than noise.
#[test]
fn exchanged_joints() {
    let (report, rounds) = said_with_rounds(|campaign| {
        for trace in &mut campaign.traces {
            trace.joints.swap(1, 2);
            (trace.joints[1].number, trace.joints[2].number) = (2, 3);
        }
    });
    assert_fault(&report, "joints 2 and 3 are exchanged");
    assert!(rounds <= 3, "{rounds}");
}

#[test]
fn a_home_position_ten_degrees_off() {
    let report = said_of(|campaign| {
        for trace in &mut campaign.traces {
            trace.joints[1].q_rad.iter_mut().for_each(|q| *q += 10_f64.to_radians());
        }
    });
    assert_fault(&report, "the home position is not the model's: joint 2 by 10.");
}

#[test]
fn lengths_a_tenth_too_long() {
    let report = said_of(|campaign| {
        let robot = &mut campaign.robot_file.robot;
        let lengths = [&mut robot.d2_m, &mut robot.a2_m, &mut robot.d3_m, &mut robot.a3_m];
        lengths.into_iter().flatten().for_each(|length| *length *= 1.1);
    });
    assert_fault(&report, "a2_m = 0.2");
}

/// Beside a cause they are no fault that is said, and do what a small force along gravity would do.
#[test]
fn lengths_two_per_cent_too_long_are_no_force_on_the_tip() {
    let report = said_of(|campaign| {
        let robot = &mut campaign.robot_file.robot;
        [&mut robot.a2_m, &mut robot.a3_m].into_iter().flatten().for_each(|m| *m *= 1.02);
        for trace in &mut campaign.traces {
            let joint = &mut trace.joints[0];
            let cogging = joint.q_rad.iter().map(|q| 0.1 * (8.0 * q).sin());
            joint.command_v.iter_mut().zip(cogging).for_each(|(v, more)| *v += more);
        }
    });
    let names: Vec<&str> = report.causes.iter().map(|cause| cause.effect.as_str()).collect();
    assert!(names.contains(&"cogging") && !names.contains(&"tip_force"), "{names:?}");
    let why =
        report.alternatives.iter().find(|other| other.effect == "tip_force").map(|it| &it.why);
    assert_eq!(
        why,
        Some(&Some("lengths off within their doubt, a tenth, would do the same".into()))
    );
    assert!(report.remarks.iter().any(|said| said.contains("lengths") && said.contains("force")));
}

#[test]
fn a_bus_that_takes_three_milliseconds() {
    let report = said_of(|campaign| {
        for joint in campaign.traces.iter_mut().flat_map(|trace| &mut trace.joints) {
            joint.command_v = [&joint.command_v[3..], &[0.0; 3]].concat();
        }
    });
    assert_fault(&report, "commands act 3.0");
}
