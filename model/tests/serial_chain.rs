//! Chains against the closed form of the three-joint robot, and against themselves.

mod common;

use common::chains::{Moving, chain_of, moving_chain};
use common::rigid_robot::{RigidRobot, State, rigid_robot, state};
use common::{cases, largest};
use model::Dual;
use model::chain::{Body, Joint, SerialChain, Transform};
use model::mechanism::{Mechanism, Rrr};
use proptest::prelude::*;

/// What a mechanism answers in a state, all outputs one after the other: inverse dynamics, mass
/// matrix, gravity, Jacobian.
fn answers(arm: &dyn Mechanism<f64>, state: &State) -> Vec<f64> {
    let State { q_rad, qd_rad_per_s, qdd_rad_per_s2 } = state;
    let mut all = vec![0.0; 3 + 9 + 3 + 18];
    let (torque, rest) = all.split_at_mut(3);
    let (mass, rest) = rest.split_at_mut(9);
    let (gravity, jacobian) = rest.split_at_mut(3);
    arm.inverse_dynamics(q_rad, qd_rad_per_s, qdd_rad_per_s2, torque);
    arm.mass_matrix(q_rad, mass);
    arm.gravity(q_rad, gravity);
    arm.tip_jacobian(q_rad, jacobian);
    all
}

/// The largest difference of two lists relative to the largest entry.
fn relative_error(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let error = largest(found.iter().zip(expected).map(|(a, b)| a - b));
    error / largest(expected.iter().copied()).max(1e-300)
}

fn closed_form(robot: &RigidRobot) -> Rrr<f64> {
    Rrr { geometry: robot.geometry, base: robot.base() }
}

fn inverse<T: model::Real>(chain: &SerialChain<T>, q: &[T], qd: &[T], qdd: &[T]) -> Vec<T> {
    let mut torque = vec![T::zero(); q.len()];
    chain.inverse_dynamics(q, qd, qdd, &mut torque);
    torque
}

proptest! {
    #![proptest_config(cases(500))]

    #[test]
    fn a_chain_is_the_closed_form(robot in rigid_robot(), state in state()) {
        let (chain, closed) = (chain_of(&robot), closed_form(&robot));
        let error = relative_error(&answers(&chain, &state), &answers(&closed, &state));
        prop_assert!(error < 1e-12, "{error:e}");
    }

    #[test]
    fn a_chain_falls_as_the_closed_form(robot in rigid_robot(), state in state()) {
        let torque = inverse(&chain_of(&robot), &state.q_rad, &state.qd_rad_per_s, &state.qdd_rad_per_s2);
        let fall = |arm: &dyn Mechanism<f64>| {
            let mut qdd = vec![0.0; 3];
            arm.forward_dynamics(&state.q_rad, &state.qd_rad_per_s, &torque, &mut qdd);
            qdd
        };
        let (chain, closed) = (fall(&chain_of(&robot)), fall(&closed_form(&robot)));
        // Both lose what the mass matrix' condition takes.
        prop_assert!(relative_error(&chain, &state.qdd_rad_per_s2) < 1e-10);
        prop_assert!(relative_error(&closed, &state.qdd_rad_per_s2) < 1e-10);
    }

    #[test]
    fn forward_dynamics_undoes_inverse_dynamics(Moving { chain, q, qd, qdd } in moving_chain()) {
        let torque = inverse(&chain, &q, &qd, &qdd);
        let mut found = vec![0.0; q.len()];
        chain.forward_dynamics(&q, &qd, &torque, &mut found);
        let error = relative_error(&found, &qdd);
        prop_assert!(error < 1e-9, "{error:e}");
    }

    #[test]
    fn the_mass_matrix_is_what_accelerations_cost(Moving { chain, q, qdd, .. } in moving_chain()) {
        let n = q.len();
        let (mut mass, mut product) = (vec![0.0; n * n], vec![0.0; n]);
        chain.mass_matrix(&q, &mut mass);
        chain.gravity(&q, &mut product);
        for (sum, row) in product.iter_mut().zip(mass.chunks(n)) {
            *sum += row.iter().zip(&qdd).map(|(d, a)| d * a).sum::<f64>();
        }
        let error = relative_error(&product, &inverse(&chain, &q, &vec![0.0; n], &qdd));
        prop_assert!(error < 1e-12, "{error:e}");
    }

    #[test]
    fn the_regressor_times_the_parameters_is_the_torque(
        Moving { chain, q, qd, qdd } in moving_chain(),
    ) {
        let p = chain.parameter_count();
        let (mut rows, mut values) = (vec![f64::NAN; q.len() * p], vec![0.0; p]);
        chain.regressor(&q, &qd, &qdd, &mut rows);
        chain.parameters(&mut values);
        let product: Vec<f64> =
            rows.chunks(p).map(|row| row.iter().zip(&values).map(|(r, p)| r * p).sum()).collect();
        let error = relative_error(&product, &inverse(&chain, &q, &qd, &qdd));
        prop_assert!(error < 1e-12, "{error:e}");
    }

    #[test]
    fn parameters_survive(Moving { chain, .. } in moving_chain()) {
        let mut values = vec![0.0; chain.parameter_count()];
        chain.parameters(&mut values);
        let mut other = chain;
        other.set_parameters(&vec![0.0; values.len()]);
        other.set_parameters(&values);
        prop_assert_eq!(other, chain);
    }

    /// By the duals of the tip's position along every joint in turn.
    #[test]
    fn the_jacobian_is_the_slope_of_the_tip(Moving { chain, q, .. } in moving_chain()) {
        let n = q.len();
        let mut rows = vec![0.0; 6 * n];
        chain.tip_jacobian(&q, &mut rows);
        for joint in 0..n {
            let mut dual: Vec<Dual<1>> = q.iter().map(|q| Dual::fixed(*q)).collect();
            dual[joint] = Dual::along(q[joint], 0);
            let tip = chain.cast::<Dual<1>>().tip(&dual).position;
            for row in 0..3 {
                let error = tip[row].slope[0] - rows[row * n + joint];
                prop_assert!(error.abs() < 1e-12, "{error:e}");
            }
        }
    }

    /// In dual numbers the slope by a parameter is the regressor's column.
    #[test]
    fn slopes_by_parameters_are_the_regressor(Moving { chain, q, qd, qdd } in moving_chain()) {
        let (n, p) = (q.len(), chain.parameter_count());
        let (mut rows, mut values) = (vec![0.0; n * p], vec![0.0; p]);
        chain.regressor(&q, &qd, &qdd, &mut rows);
        chain.parameters(&mut values);
        let [q, qd, qdd] = [q, qd, qdd].map(|x| x.into_iter().map(Dual::<1>::fixed).collect::<Vec<_>>());
        for parameter in (0..p).step_by(7) {
            let dual = |(k, x): (usize, &f64)| if k == parameter { Dual::along(*x, 0) } else { Dual::fixed(*x) };
            let mut varied = chain.cast::<Dual<1>>();
            varied.set_parameters(&values.iter().enumerate().map(dual).collect::<Vec<_>>());
            let torque = inverse(&varied, &q, &qd, &qdd);
            for joint in 0..n {
                let expected = rows[joint * p + parameter];
                let error = torque[joint].slope[0] - expected;
                prop_assert!(error.abs() < 1e-11 * expected.abs().max(100.0), "{error:e}");
            }
        }
    }

    #[test]
    fn ten_numbers_are_a_body_and_back(Moving { chain, .. } in moving_chain()) {
        for joint in chain.joints() {
            let numbers = joint.body.log_cholesky().unwrap();
            let again = Body::of_log_cholesky(&numbers).to_array();
            prop_assert!(relative_error(&again, &joint.body.to_array()) < 1e-11);
        }
    }

    #[test]
    fn any_ten_numbers_are_matter(numbers in proptest::array::uniform10(-2.0..2.0)) {
        let body = Body::of_log_cholesky(&numbers);
        prop_assert!(body.is_physical());
        prop_assert!(relative_error(&body.log_cholesky().unwrap(), &numbers) < 1e-6);
        prop_assert_eq!(Body { mass_kg: -body.mass_kg, ..body }.log_cholesky(), None);
    }

    #[test]
    fn links_of_point_masses_are_physical(Moving { chain, .. } in moving_chain()) {
        prop_assert!(chain.joints().all(|joint| joint.body.is_physical()));
        let [mut lighter, mut flatter] = [chain.joints().next().unwrap().body; 2];
        lighter.mass_kg *= -1.0;
        flatter.inertia_kg_m2[0] = -1.0;
        prop_assert!(!lighter.is_physical() && !flatter.is_physical());
    }
}

#[test]
fn a_payload_is_a_part_of_the_last_link() {
    let joint = Joint {
        kind: model::mechanism::JointKind::Prismatic,
        origin: Transform::identity(),
        axis: [0.0, 0.0, 2.0],
        body: Body::zero(),
        armature: 0.0,
    };
    let chain = SerialChain::new([0.0, 0.0, -10.0], &[joint]).unwrap();
    let loaded = chain.with_payload(&Body::point(3.0, [0.1, 0.2, 0.3]));
    assert_eq!(inverse(&loaded, &[0.0], &[1.0], &[2.0]), [36.0]);
    assert_eq!(inverse(&chain, &[0.0], &[1.0], &[2.0]), [0.0]);
}

#[test]
fn what_is_no_chain_is_refused() {
    let joint = Joint {
        kind: model::mechanism::JointKind::Revolute,
        origin: Transform::identity(),
        axis: [0.0; 3],
        body: Body::zero(),
        armature: 0.0,
    };
    let refused =
        |joints: &[Joint<f64>]| SerialChain::new([0.0; 3], joints).unwrap_err().to_string();
    assert_eq!(refused(&[]), "number of joints is 0, but must be 1 to 10");
    let good = Joint { axis: [0.0, 1.0, 0.0], ..joint };
    assert_eq!(refused(&[good; 11]), "number of joints is 11, but must be 1 to 10");
    assert_eq!(refused(&[good, joint]), "axis of joint 2 is 0, but must be above 0");
    let mut nowhere = good;
    nowhere.origin.position[1] = f64::NAN;
    assert!(refused(&[nowhere]).starts_with("origin_xyz_m of joint 1 is NaN"));
}
