//! Causes on several joints of an arm of six: each is named, whichever round finds it.

mod arms;

use arms::recorded;
use diagnosis::{Criteria, Report};
use files::example_arms::six_axes;
use rig::effects::Catalogue;

/// What an arm of six joints is told that has these effects.
fn told(hidden: &[&str]) -> Report {
    let arm = six_axes();
    let campaign = recorded(&arm, 125.0, 12.0, hidden);
    let catalogue = Catalogue::of_arm(arm.joints.len());
    let found =
        diagnosis::diagnose_arm(&campaign, &catalogue, &Criteria::default(), &|_| ()).unwrap();
    eprintln!("{}", host_tool::commands::diagnose::in_words(&found));
    found.report
}

#[test]
fn causes_of_four_joints_are_all_named() {
    let report = told(&[
        "cogging:1:amplitude_V=0.08,harmonic=7,phase_rad=0.4",
        "asymmetric_friction:2:relative_asymmetry=0.2",
        "dac_offset:4:offset_V=0.05",
        "cogging:6:amplitude_V=0.05,harmonic=2,phase_rad=1.0",
    ]);
    let mut named: Vec<(&str, u8)> =
        report.causes.iter().map(|cause| (cause.effect.as_str(), cause.joint)).collect();
    named.sort_unstable_by_key(|(_, joint)| *joint);
    let wanted = [("cogging", 1), ("asymmetric_friction", 2), ("dac_offset", 4), ("cogging", 6)];
    assert_eq!(named, wanted);
}
