//! The six labelled gaps of an independent simulator, whose causes are known.

use std::cell::RefCell;
use std::path::{Path, PathBuf};

use diagnosis::{Cause, Criteria, Diagnosis, Value, Verdict, diagnose, diagnose_suspecting};
use files::{Dataset, EffectTable, RobotFile};
use recordings::Campaign;
use rig::effects::Catalogue;

fn labelled(number: u32) -> Option<PathBuf> {
    test_support::data(&format!("labelled/labelled-{number}"))
}

fn diagnosis(directory: &Path) -> Diagnosis {
    diagnosis_by(directory, &Criteria::default())
}

fn diagnosis_by(directory: &Path, criteria: &Criteria) -> Diagnosis {
    diagnose(&campaign(directory), &Catalogue::standard(), criteria, &|_| ()).unwrap()
}

fn campaign(directory: &Path) -> Campaign {
    let dataset = Dataset::read(directory).unwrap();
    let model = RobotFile::read(directory.join("model.toml")).unwrap();
    Campaign::read(&dataset, model).unwrap()
}

/// What a search says on its way that tries an effect on a joint first, and what it finds.
fn suspecting(
    directory: &Path,
    effect: &str,
    joint: u8,
    parameters: &[(&str, f64)],
) -> (String, Diagnosis) {
    let parameters = parameters.iter().map(|&(name, value)| (name.to_owned(), value.into()));
    let table = EffectTable {
        effect: effect.into(),
        joint,
        parameters: parameters.collect(),
        ..Default::default()
    };
    let (criteria, said) = (Criteria::default(), RefCell::new(String::new()));
    let hear = |words: &str| *said.borrow_mut() += &format!("{words}\n");
    let catalogue = Catalogue::standard();
    let found =
        diagnose_suspecting(&campaign(directory), &catalogue, &criteria, &[table], &hear).unwrap();
    (said.take(), found)
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

/// One that is there spares the round that finds it; one that is not leaves the answer as it is.
#[test]
fn effects_that_are_suspected_stay_where_the_logs_bear_them_out() {
    let Some(directory) = labelled(1) else { return };
    let cogging = [("amplitude_V", 0.11), ("harmonic", 8.0), ("phase_rad", 0.9)];
    let (said, right) = suspecting(&directory, "cogging", 3, &cogging);
    assert!(!said.contains("round 1\n"), "{said}");
    let (said, wrong) = suspecting(&directory, "dac_offset", 2, &[("offset_V", 0.2)]);
    assert!(said.contains("round 1\n"), "{said}");
    for found in [right, wrong] {
        assert_eq!(found.report.causes.len(), 1, "{:?}", found.report.causes);
        assert_cause(&found.report.causes[0], "cogging", 3, &cogging);
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
