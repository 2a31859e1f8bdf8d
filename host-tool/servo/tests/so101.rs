//! The SO-101 arm, where the collected data lie beside the project.

use files::{ArmFile, Dataset};
use recordings::ArmCampaign;
use servo::prepared::Prepared;
use servo::report::report;
use servo::{Outcome, Settings};

fn campaign() -> Option<ArmCampaign> {
    let directory = test_support::data("real/so101")?;
    let arm = ArmFile::read(directory.join("model.toml")).unwrap();
    Some(ArmCampaign::read(&Dataset::read(&directory).unwrap(), arm).unwrap())
}

/// The logs that are known to press the tip onto the table.
const PRESSING: [&str; 7] = [
    "boundary_exploration",
    "diagonal_sweep",
    "dual_joint_elbow_wrist",
    "figure_eight",
    "oscillation_low_freq",
    "oscillation_med_freq",
    "workspace_sweep",
];

#[test]
fn contacts_and_clipped_goals_are_found_and_nothing_beside() {
    let Some(campaign) = campaign() else { return };
    let prepared = Prepared::of(&campaign, &Settings::default()).unwrap();
    let has = |name: &str| prepared.contacts.iter().any(|c| c.file.starts_with(name));
    for name in PRESSING {
        assert!(has(name), "{name}");
    }
    // These reach the same place on the table, three times.
    let known = |file: &str| PRESSING.iter().any(|name| file.starts_with(name));
    let others = prepared.contacts.iter().filter(|contact| !known(&contact.file));
    assert!(others.clone().all(|contact| contact.file.starts_with("reaching_points")));
    let clips: Vec<_> = prepared.clips.iter().map(|c| (c.file.as_str(), c.joint)).collect();
    assert_eq!(clips, [("single_joint_wrist_roll.csv.gz", 5)]);
}

/// Takes minutes: 50 minutes of logs of six joints, all effects.
#[test]
#[ignore = "minutes; `cargo test --release -p servo --test so101 -- --ignored`"]
fn what_is_known_of_the_arm_is_named_and_nothing_else() {
    let Some(campaign) = campaign() else { return };
    let outcome = Outcome::of(&campaign, &Settings::default(), &|_| ()).unwrap();
    let report = report(&outcome);
    let named = |effect: &str, joint: u8| {
        report.causes.iter().any(|cause| cause.effect == effect && cause.joint == joint)
    };
    assert!(named("saturation", 6) && named("load_friction", 2), "{:?}", report.causes);
    for effect in [
        "delay",
        "dead_zone",
        "backlash",
        "friction_drift",
        "dac_offset",
        "cogging",
        "cable_spring",
    ] {
        assert!(report.causes.iter().all(|cause| cause.effect != effect), "{effect}");
    }
    let rms = |rad: &[f64]| (rad.iter().map(|x| x * x).sum::<f64>() / rad.len() as f64).sqrt();
    assert!(rms(&report.gap.refitted_rad) < 10.6e-3, "{:?}", report.gap.refitted_rad);
    assert!(rms(&report.gap.with_effects_rad) < 7.4e-3, "{:?}", report.gap.with_effects_rad);
}
