//! Arms whose joints turn and slide under drives of several kinds, by a model whose masses and friction are some percent
//! off.

mod arms;

use arms::{Case, all_are_named, diagnosed, recorded};
use diagnosis::{Report, Verdict};
use files::ArmFile;
use files::example_arms::{gantry, scara};

/// The arm with other masses and Coulomb friction, in parts of them, joint by joint in turn.
fn off(mut arm: ArmFile) -> ArmFile {
    let parts = [1.02, 0.985, 1.01, 0.98];
    for (joint, part) in arm.joints.iter_mut().zip(parts) {
        joint.link.mass_kg = joint.link.mass_kg.map(|mass_kg| mass_kg * part);
        if let Some(friction) = &mut joint.friction {
            friction.alpha0 = friction.alpha0.map(|alpha0| alpha0 * (2.0 - part));
        }
    }
    arm
}

fn of(arm: ArmFile, hidden: &[&str]) -> Report {
    let mut campaign = recorded(&arm, 250.0, 10.0, hidden);
    campaign.arm = off(arm);
    diagnosed(&campaign).report
}

fn of_scara(hidden: &[&str]) -> Report {
    of(scara(), hidden)
}

fn of_gantry(hidden: &[&str]) -> Report {
    of(gantry(), hidden)
}

#[test]
fn arms_as_their_models_have_no_gap() {
    for report in [of_scara(&[]), of_gantry(&[])] {
        assert_eq!((report.verdict, report.causes.len()), (Verdict::None, 0));
    }
}

/// All drives of this arm take currents, and its third joint slides.
#[test]
fn what_no_log_would_show_is_said_in_the_joints_own_units() {
    let report = of_scara(&[]);
    let friction = report.untestable.iter().find(|u| u.effect == "load_friction").unwrap();
    assert_eq!(friction.joint, 3);
    assert!(friction.why.contains(" A/N (coefficient)"), "{}", friction.why);
    let volts = |why: &String| why.contains(" V ") || why.contains(" mV ");
    assert!(!report.untestable.iter().any(|u| volts(&u.why)));
}

#[test]
fn single_causes_of_an_arm_with_a_slide_between_turning_joints_are_named() {
    let cases: &[Case] = &[
        ("payload:mass_kg=0.8,com_m=0 0 -0.05", "payload", 0, ("mass_kg", 0.8), 0.1),
        ("delay:2:delay_s=0.004", "delay", 2, ("delay_s", 0.004), 0.05),
        (
            "asymmetric_friction:3:relative_asymmetry=0.3",
            "asymmetric_friction",
            3,
            ("relative_asymmetry", 0.3),
            0.05,
        ),
    ];
    all_are_named(of_scara, cases);
}

#[test]
fn single_causes_of_slides_under_volts_newtons_and_amperes_are_named() {
    let cases: &[Case] = &[
        (
            "cable_spring:1:stiffness_V_per_rad=1,rest_rad=0.1",
            "cable_spring",
            1,
            ("stiffness_V_per_rad", 1.0),
            0.05,
        ),
        (
            "quadratic_drag:2:coefficient_V_s2_per_rad2=30",
            "quadratic_drag",
            2,
            ("coefficient_V_s2_per_rad2", 30.0),
            0.05,
        ),
        ("saturation:3:limit_V=1.7", "saturation", 3, ("limit_V", 1.7), 0.05),
    ];
    all_are_named(of_gantry, cases);
}

/// On slides a load weighs the same wherever it is.
#[test]
fn a_place_that_no_motion_tells_has_an_interval_of_all_places() {
    let report = of_gantry(&["payload:mass_kg=1.5"]);
    let place = &report.causes[0].parameter_intervals["com_m"];
    assert_eq!(*place, diagnosis::Interval::Vector(vec![[-2.0, 2.0]; 3]));
}
