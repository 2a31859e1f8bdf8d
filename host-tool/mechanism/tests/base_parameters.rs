//! Base parameters that are found, against those that are known.

use mechanism::{BaseParameters, Observation, Settings};
use model::chain::{Body, Joint, SerialChain, Transform, rotation_of_rpy};
use model::mechanism::{JointKind, Mechanism, Rrr};
use model::reference_robot::reference_robot;

const GRAVITY: [f64; 3] = [0.0, 0.0, -9.81];

fn joint(kind: JointKind, position: [f64; 3], rpy: [f64; 3]) -> Joint<f64> {
    let body = Body::about_centre(2.0, [0.1, 0.02, -0.03], [0.03, 0.001, 0.002, 0.04, 0.0, 0.02]);
    let origin = Transform { rotation: rotation_of_rpy(rpy), position };
    Joint { kind, origin, axis: [0.0, 0.0, 1.0], body, armature: 0.1 }
}

fn turning(position: [f64; 3], rpy: [f64; 3]) -> Joint<f64> {
    joint(JointKind::Revolute, position, rpy)
}

/// The three joints of MODEL.md.
fn rrr() -> SerialChain<f64> {
    let joints = [
        turning([0.0; 3], [0.0; 3]),
        turning([0.0, 0.0, 0.56], [std::f64::consts::FRAC_PI_2, 0.0, 0.0]),
        turning([0.2, 0.0, 0.169], [0.0; 3]),
    ];
    SerialChain::new(GRAVITY, &joints).unwrap()
}

fn base_of(arm: &dyn Mechanism<f64>) -> BaseParameters {
    BaseParameters::of(arm, &Settings::default())
}

fn words(base: &BaseParameters) -> Vec<String> {
    base.combinations.iter().map(ToString::to_string).collect()
}

#[test]
fn the_base_parameters_of_the_closed_form_are_all_that_there_are() {
    let base = base_of(&Rrr::of(&reference_robot()));
    assert_eq!(words(&base), model::base::NAMES);
    assert!(base.without_effect.is_empty());
}

#[test]
fn a_pendulum_has_an_inertia_and_two_moments() {
    let axis = turning([0.0; 3], [std::f64::consts::FRAC_PI_2, 0.0, 0.0]);
    let base = base_of(&SerialChain::new(GRAVITY, &[axis]).unwrap());
    let expected =
        ["joint[1].mx_kg_m", "joint[1].my_kg_m", "joint[1].izz_kg_m2 + joint[1].armature_kg_m2"];
    assert_eq!(words(&base), expected);
    assert_eq!(base.without_effect.len(), 7);
}

#[test]
fn a_linear_axis_has_a_mass() {
    let axis = joint(JointKind::Prismatic, [0.0; 3], [0.0; 3]);
    let level = SerialChain::new([0.0, -9.81, 0.0], &[axis]).unwrap();
    assert_eq!(words(&base_of(&level)), ["joint[1].mass_kg + joint[1].armature_kg"]);
    // Gravity along the axis weighs the mass, not the rotor.
    let upright = SerialChain::new(GRAVITY, &[axis]).unwrap();
    assert_eq!(words(&base_of(&upright)), ["joint[1].mass_kg", "joint[1].armature_kg"]);
}

/// The sixteen of MODEL.md: zz1r takes up the masses, a rotor of its own has joint 3 alone.
#[test]
fn the_three_joint_robot_has_sixteen() {
    let base = base_of(&rrr());
    assert_eq!(base.combinations.len(), model::base::COUNT);
    let words = words(&base);
    assert!(words.contains(&"joint[3].armature_kg_m2".to_owned()), "{words:#?}");
    let elbow = "joint[2].mx_kg_m + 0.2 joint[3].mass_kg".to_owned();
    assert!(words.contains(&elbow), "{words:#?}");
    let flat = "joint[3].ixx_kg_m2 - joint[3].iyy_kg_m2".to_owned();
    assert!(words.contains(&flat), "{words:#?}");
}

#[test]
fn the_rank_is_that_of_a_pivoted_decomposition() {
    let six: Vec<Joint<f64>> = (0..6)
        .map(|k| turning([0.1, 0.02 * f64::from(k), 0.3], [1.5 - 0.4 * f64::from(k), 0.3, 0.7]))
        .collect();
    let six = SerialChain::new(GRAVITY, &six).unwrap();
    for arm in [rrr(), six] {
        let observation = Observation::of(&arm, &Settings::default());
        let diagonal = observation.matrix.col_piv_qr().unpack_r().diagonal();
        let rank = diagonal.iter().filter(|entry| entry.abs() > 1e-6).count();
        assert_eq!(base_of(&arm).combinations.len(), rank);
    }
}

#[test]
fn the_combinations_give_the_torques() {
    let arm = rrr();
    let base = base_of(&arm);
    let p = arm.parameter_count();
    let mut parameters = vec![0.0; p];
    arm.parameters(&mut parameters);
    let (q, qd, qdd) = ([0.3, -1.2, 0.8], [1.5, -2.0, 3.0], [9.0, -8.0, 7.0]);
    let (mut rows, mut torque) = (vec![0.0; 3 * p], [0.0; 3]);
    arm.regressor(&q, &qd, &qdd, &mut rows);
    arm.inverse_dynamics(&q, &qd, &qdd, &mut torque);
    for (row, torque) in rows.chunks(p).zip(torque) {
        let columns = base.columns().into_iter().map(|column| row[column]);
        let product: f64 = columns.zip(base.values(&parameters)).map(|(r, b)| r * b).sum();
        assert!((product - torque).abs() < 1e-9 * torque.abs().max(1.0), "{product} {torque}");
    }
}
