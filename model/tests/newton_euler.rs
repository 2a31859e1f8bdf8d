//! The closed form and the base parameters of MODEL.md against a recursive
//! Newton-Euler of whole links, for random robots and states.

mod common;

use common::newton_euler::inverse_dynamics as newton_euler;
use common::rigid_robot::{RigidRobot, State, rigid_robot, state};
use common::{cases, largest};
use model::{Posture, Real};
use proptest::collection::vec;
use proptest::prelude::*;

/// The closed form in the number type `T`; parameters and state are rounded to it.
fn closed_form<T: Real>(robot: &RigidRobot, state: &State) -> [f64; 3] {
    let cast = |x: [f64; 3]| x.map(T::constant);
    let q = cast(state.q_rad);
    Posture::new(q[1], q[2])
        .inverse_dynamics(
            &robot.base().cast(),
            &robot.geometry.cast(),
            &cast(state.qd_rad_per_s),
            &cast(state.qdd_rad_per_s2),
        )
        .map(Real::as_f64)
}

/// Largest error of the closed form, and the largest torque, of any joint in any state [Nm].
fn error_and_full_scale<T: Real>(robot: &RigidRobot, states: &[State]) -> (f64, f64) {
    let exact: Vec<_> = states.iter().map(|state| newton_euler(robot, state)).collect();
    let errors = states.iter().zip(&exact).flat_map(|(state, exact)| {
        let got = closed_form::<T>(robot, state);
        [0, 1, 2].map(|joint| got[joint] - exact[joint])
    });
    (largest(errors), largest(exact.iter().flatten().copied()))
}

proptest! {
    #![proptest_config(cases(2000))]

    #[test]
    fn closed_form_is_newton_euler(robot in rigid_robot(), states in vec(state(), 20)) {
        let (error_nm, _) = error_and_full_scale::<f64>(&robot, &states);
        prop_assert!(error_nm < 1e-9, "{error_nm:e} Nm");
    }

    /// Full scale is the largest torque of any joint over the robot's 20 states.
    #[test]
    fn f32_is_newton_euler_to_1e_5_of_full_scale(
        robot in rigid_robot(),
        states in vec(state(), 20),
    ) {
        let (error_nm, full_scale_nm) = error_and_full_scale::<f32>(&robot, &states);
        let error = error_nm / full_scale_nm;
        prop_assert!(error < 1e-5, "{error:e} of {full_scale_nm} Nm");
    }
}
