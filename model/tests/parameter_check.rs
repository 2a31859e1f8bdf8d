//! A robot that cannot be is rejected, and the error names the parameter.

use model::base::{COUNT, NAMES};
use model::reference_robot::reference_robot;
use model::{BaseParameters, ParameterError, Robot};

fn robot() -> Robot<f64> {
    reference_robot()
}

/// The error for the reference robot with something changed.
fn error_of(change: impl FnOnce(&mut Robot<f64>)) -> ParameterError {
    let mut changed = robot();
    change(&mut changed);
    changed.checked().unwrap_err()
}

#[test]
fn every_base_parameter_that_is_no_number_is_named() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for (index, name) in (0..COUNT).zip(NAMES) {
            let mut p = robot().base.to_array();
            p[index] = bad;
            let error = BaseParameters::from_array(p).check(&robot().geometry).unwrap_err();
            assert_eq!((error.name, error.must), (name, "be a finite number"));
        }
    }
}

#[test]
fn a_mass_matrix_that_is_not_positive_definite_is_named_by_its_joint() {
    let name = |change: fn(&mut BaseParameters<f64>)| error_of(|r| change(&mut r.base)).name;
    assert_eq!(name(|p| p.zz3r = -p.ia3), "zz3r + ia3");
    assert_eq!(name(|p| p.zz2r = 0.0), "zz2r (minor of joints 2 and 3)");
    assert_eq!(name(|p| p.zz1r = 0.0), "zz1r (determinant)");
}

/// The mass matrix loses its definiteness in a small region of postures only: just
/// below the value where the determinant's lowest point is zero.
#[test]
fn a_hole_in_a_few_postures_is_found() {
    let passes = |zz1r: f64| {
        let base = BaseParameters { zz1r, ..robot().base };
        base.check(&robot().geometry).is_ok()
    };
    let (mut fails, mut holds) = (0.0, robot().base.zz1r);
    while holds - fails > 1e-9 {
        let middle = 0.5 * (fails + holds);
        if passes(middle) { holds = middle } else { fails = middle }
    }
    let base = BaseParameters { zz1r: holds - 1e-5, ..robot().base };
    let bad = fine_grid().filter(|&(q2, q3)| determinant(&base, q2, q3) <= 0.0).count();
    assert!(!passes(holds - 1e-5) && (1..100).contains(&bad), "{bad} of a million");
}

fn fine_grid() -> impl Iterator<Item = (f64, f64)> {
    let angle = |i: i32| f64::from(i) * std::f64::consts::TAU / 1000.0;
    (0..1000).flat_map(move |i| (0..1000).map(move |j| (angle(i), angle(j))))
}

fn determinant(base: &BaseParameters<f64>, q2: f64, q3: f64) -> f64 {
    let d = model::Posture::new(q2, q3).mass_matrix(base, &robot().geometry);
    model::vector::leading_minors(&d)[2]
}

#[test]
fn friction_is_named_with_its_joint() {
    let error = error_of(|r| r.friction[1].alpha1_v = -r.friction[1].alpha0_v);
    assert_eq!((error.name, error.joint), ("alpha1_V", 2));
    let error = error_of(|r| r.friction[2].sigma0_v_per_rad = 0.0);
    assert_eq!((error.name, error.joint), ("sigma0_V_per_rad", 3));
    assert_eq!(error.to_string(), "sigma0_V_per_rad of joint 3 is 0, but must be above 0");
}

#[test]
fn geometry_and_torque_constants_are_named() {
    assert_eq!(error_of(|r| r.geometry.d2_m = f64::NAN).name, "d2_m");
    assert_eq!(error_of(|r| r.geometry.a2_m = -0.1).name, "a2_m");
    let error = error_of(|r| r.torque_constant_nm_per_v[0] = 0.0);
    assert_eq!((error.name, error.joint), ("torque_constant_Nm_per_V", 1));
}
