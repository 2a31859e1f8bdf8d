use rig::effects::Catalogue;

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

#[test]
fn friction_by_load_that_takes_more_than_the_load_is_drawn_again() {
    let arm = ArmKind::SixServos.nominal();
    let plant = case::plant(&arm).unwrap();
    let load_friction = Catalogue::of_arm(6).by_name("load_friction").unwrap();
    let gain = plant.torque_constant_nm_per_v[0];
    let can_be = |coefficient_v_per_nm: f64| {
        sizes::can_be(load_friction, 1, &[coefficient_v_per_nm], &plant)
    };
    assert!(can_be(0.9 / gain) && !can_be(1.1 / gain));
}

/// Turned about the vertical an arm needs what it needed: what a second fit gains by going further is not the effect's.
#[test]
fn another_home_position_about_the_vertical_cannot_be_known() {
    let settings =
        ArmTrialSettings { arm: ArmKind::SixAxes, seed: 73019, first: 74, cases: 1, kind: None };
    let case = &draw_arms(&settings, &|| ()).unwrap()[0];
    let cause = case.cause.as_ref().unwrap();
    assert_eq!((cause.effect.as_str(), cause.joint), ("encoder_offset", 1));
    assert!(case.oracle.unwrap() < 0.1, "{:?}", case.oracle);
}
