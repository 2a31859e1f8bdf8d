//! What the closed form must fulfil for every robot that could be built.

mod common;

use common::rigid_robot::{RigidRobot, rigid_robot, state};
use common::{cases, largest};
use model::Posture;
use model::regressor::regressor;
use model::vector::{leading_minors, multiply};
use nalgebra::Matrix3;
use proptest::array::uniform3;
use proptest::prelude::*;

fn mass_matrix(robot: &RigidRobot, q: &[f64; 3]) -> Matrix3<f64> {
    let rows = Posture::new(q[1], q[2]).mass_matrix(&robot.base(), &robot.geometry);
    Matrix3::from(rows).transpose()
}

/// dD/dt along the velocity, by a central difference of fourth order.
fn mass_matrix_rate(robot: &RigidRobot, q: &[f64; 3], qd: &[f64; 3]) -> Matrix3<f64> {
    let step_s = 1e-4;
    let at = |n: f64| mass_matrix(robot, &[0, 1, 2].map(|i| q[i] + n * step_s * qd[i]));
    (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * step_s)
}

fn largest_difference(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    largest([0, 1, 2].map(|i| a[i] - b[i]))
}

proptest! {
    #![proptest_config(cases(2000))]

    #[test]
    fn mass_matrix_is_symmetric_and_positive_definite(robot in rigid_robot(), s in state()) {
        let d = mass_matrix(&robot, &s.q_rad);
        prop_assert_eq!(d, d.transpose());
        let rows = d.transpose().into();
        prop_assert!(leading_minors(&rows).iter().all(|&minor| minor > 0.0), "{}", d);
    }

    #[test]
    fn base_parameters_of_links_pass_the_check(robot in rigid_robot()) {
        prop_assert_eq!(robot.base().check(&robot.geometry), Ok(()));
    }

    #[test]
    fn rate_of_mass_matrix_less_twice_coriolis_is_skew(robot in rigid_robot(), s in state()) {
        let qd = s.qd_rad_per_s;
        let posture = Posture::new(s.q_rad[1], s.q_rad[2]);
        let c = Matrix3::from(posture.coriolis_matrix(&robot.base(), &robot.geometry, &qd));
        let rate = mass_matrix_rate(&robot, &s.q_rad, &qd);
        let asymmetry = (rate - (c + c.transpose())).amax();
        prop_assert!(asymmetry < 1e-9 * (1.0 + rate.amax()), "{asymmetry:e}");
    }

    #[test]
    fn coriolis_matrix_times_velocity_is_coriolis(robot in rigid_robot(), s in state()) {
        let (base, qd) = (robot.base(), s.qd_rad_per_s);
        let posture = Posture::new(s.q_rad[1], s.q_rad[2]);
        let product = multiply(&posture.coriolis_matrix(&base, &robot.geometry, &qd), &qd);
        let error = largest_difference(&product, &posture.coriolis(&base, &robot.geometry, &qd));
        prop_assert!(error < 1e-11, "{error:e} Nm");
    }

    #[test]
    fn gravity_is_the_slope_of_potential_energy(robot in rigid_robot(), s in state()) {
        let base = robot.base();
        let [_, q2, q3] = s.q_rad;
        let energy = |q2, q3| Posture::new(q2, q3).potential_energy(&base, &robot.geometry);
        let step = 1e-5;
        let slope = [
            0.0,
            (energy(q2 + step, q3) - energy(q2 - step, q3)) / (2.0 * step),
            (energy(q2, q3 + step) - energy(q2, q3 - step)) / (2.0 * step),
        ];
        let gravity = Posture::new(q2, q3).gravity(&base, &robot.geometry);
        let error = largest_difference(&slope, &gravity);
        prop_assert!(error < 1e-7, "{error:e} Nm");
    }

    #[test]
    fn inverse_undoes_forward(robot in rigid_robot(), s in state(), torque in uniform3(-50.0..50.0)) {
        let (base, geometry, qd) = (robot.base(), robot.geometry, s.qd_rad_per_s);
        let posture = Posture::new(s.q_rad[1], s.q_rad[2]);
        let acceleration = posture.forward_dynamics(&base, &geometry, &qd, &torque);
        let back = posture.inverse_dynamics(&base, &geometry, &qd, &acceleration);
        let error = largest_difference(&torque, &back);
        prop_assert!(error < 1e-9, "{error:e} Nm");
    }

    #[test]
    fn regressor_times_parameters_is_inverse_dynamics(robot in rigid_robot(), s in state()) {
        let (base, geometry) = (robot.base(), robot.geometry);
        let posture = Posture::new(s.q_rad[1], s.q_rad[2]);
        let rows = regressor(&posture, &geometry, &s.qd_rad_per_s, &s.qdd_rad_per_s2);
        let product =
            rows.map(|row| row.iter().zip(base.to_array()).map(|(r, p)| r * p).sum::<f64>());
        let torque =
            posture.inverse_dynamics(&base, &geometry, &s.qd_rad_per_s, &s.qdd_rad_per_s2);
        let error = largest_difference(&product, &torque);
        let full_scale = largest(torque).max(1.0);
        prop_assert!(error < 1e-12 * full_scale, "{error:e} of {full_scale} Nm");
    }
}
