//! The six labelled gaps of an independent simulator, whose causes are known.

use std::path::{Path, PathBuf};

use diagnosis::{Cause, Criteria, Diagnosis, Value, Verdict, diagnose};
use files::{Dataset, RobotFile};
use recordings::Campaign;
use rig::effects::Catalogue;

fn labelled(number: u32) -> Option<PathBuf> {
    test_support::data(&format!("labelled/labelled-{number}"))
}

fn diagnosis(directory: &Path) -> Diagnosis {
    diagnosis_by(directory, &Criteria::default())
}

fn diagnosis_by(directory: &Path, criteria: &Criteria) -> Diagnosis {
    let dataset = Dataset::read(directory).unwrap();
    let model = RobotFile::read(directory.join("model.toml")).unwrap();
    let campaign = Campaign::read(&dataset, model).unwrap();
    diagnose(&campaign, &Catalogue::standard(), criteria, &|_| ()).unwrap()
}

fn number(cause: &Cause, name: &str) -> f64 {
    match cause.parameters[name] {
        Value::Number(number) => number,
        Value::Vector(_) => f64::NAN,
    }
}

/// Checks that effect, joint and parameters are those of the truth, these to 3 %.
#[track_caller]
fn assert_cause(cause: &Cause, effect: &str, joint: u8, parameters: &[(&str, f64)]) {
    assert_eq!((cause.effect.as_str(), cause.joint), (effect, joint));
    for &(name, truth) in parameters {
        let found = number(cause, name);
        assert!((found - truth).abs() < 0.03 * truth.abs(), "{name}: {found} for {truth}");
    }
    assert!(cause.confidence > 0.9, "{}", cause.confidence);
    let [low, high] = cause.shrinkage_interval;
    assert!((low..=high).contains(&cause.shrinkage) && cause.shrinkage > 0.5, "{cause:?}");
}

#[test]
fn single_causes_are_found_with_their_parameters() {
    let cogging = [("amplitude_V", 0.11), ("harmonic", 8.0), ("phase_rad", 0.9)];
    let truths = [
        (1, "cogging", 3, &cogging[..]),
        (2, "asymmetric_friction", 1, &[("relative_asymmetry", 0.3)]),
        (3, "payload", 0, &[("mass_kg", 0.3)]),
        (4, "actuator_lag", 2, &[("time_constant_s", 0.006)]),
    ];
    for (case, effect, joint, parameters) in truths {
        let Some(directory) = labelled(case) else { return };
        let report = diagnosis(&directory).report;
        assert_eq!(report.verdict, Verdict::Effect, "case {case}");
        assert_eq!(report.causes.len(), 1, "case {case}: {:?}", report.causes);
        assert_cause(&report.causes[0], effect, joint, parameters);
    }
}

#[test]
fn a_robot_without_effect_has_none() {
    let Some(directory) = labelled(5) else { return };
    let report = diagnosis(&directory).report;
    assert_eq!((report.verdict, report.causes.len()), (Verdict::None, 0));
    // What these logs would have shown: all twenty effects, small ones too.
    assert!(report.detectable.len() > 50, "{}", report.detectable.len());
}

#[test]
fn two_causes_on_two_joints_are_both_found() {
    let Some(directory) = labelled(6) else { return };
    let report = diagnosis(&directory).report;
    let mut causes = report.causes.clone();
    causes.sort_by_key(|cause| cause.joint);
    assert_eq!(causes.len(), 2, "{causes:?}");
    let friction = [("relative_amplitude", 0.4), ("harmonic", 2.0), ("phase_rad", -1.1)];
    assert_cause(&causes[0], "position_friction", 2, &friction);
    assert_cause(&causes[1], "dac_offset", 3, &[("offset_V", 0.09)]);
    let gap = &report.gap;
    for joint in [1, 2] {
        assert!(gap.with_effects_v[joint] < 0.05 * gap.refitted_v[joint]);
        assert!(gap.with_effects_rad[joint] < 0.05 * gap.refitted_rad[joint]);
    }
}
