use super::*;
use crate::case::Kind;

fn settings(arm: ArmKind, kind: Kind) -> ArmTrialSettings {
    ArmTrialSettings { arm, seed: 3, first: 1, cases: 2, kind: Some(kind) }
}

#[test]
fn same_seed_same_cases_and_values_within_their_bounds() {
    let settings = settings(ArmKind::RotaryJoint, Kind::Single);
    let [one, other] = [0, 1].map(|_| draw_arms(&settings, &|| ()).unwrap());
    for (one, other) in one.iter().zip(&other) {
        assert_eq!((&one.cause, one.seed), (&other.cause, other.seed));
        assert_eq!(one.truth, other.truth);
        assert_ne!(one.truth, one.nominal);
        assert!(one.cause.is_some() && one.oracle.is_some(), "{:?}", one.cause);
    }
}

#[test]
fn a_clean_arm_has_nothing_hidden_and_the_diagnosis_sees_its_model_alone() {
    let case = &draw_arms(&settings(ArmKind::LinearJoint, Kind::None), &|| ()).unwrap()[0];
    let campaign = case.record().unwrap();
    assert!(case.cause.is_none() && case.oracle.is_none());
    assert_eq!(campaign.arm, case.nominal);
}
