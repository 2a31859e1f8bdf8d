//! The true robot of a case, and its nominal model, which the diagnosis gets.

use model::links::{Link, base_parameters};
use model::reference_robot::reference_robot;
use model::{BaseParameters, Friction, Robot};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::Rng;
use identification::physical::{Physical, nearest};
use rig::effects::Random;

/// How far a true robot's physical quantities are from the reference robot's.
const ROBOT_SPREAD: f64 = 0.15;
/// Relative standard deviation of a nominal parameter from the true one.
const MODEL_ERROR: f64 = 0.02;
/// Errors of the model are cut here [standard deviations].
const MODEL_ERROR_LIMIT: f64 = 2.5;
/// Draws of a robot before it is taken as it is.
const ATTEMPTS: u32 = 100;

/// Draws robots like the reference robot, from its rigid links.
#[derive(Clone, Debug)]
pub struct RobotGenerator {
    links: Option<Physical>,
}

impl RobotGenerator {
    /// Finds links that have the reference robot's base parameters.
    pub fn new() -> Self {
        let robot = reference_robot::<f64>();
        let variances = robot.base.to_array().map(|p| (0.01 * p.abs().max(0.01)).powi(2));
        let covariance = DMatrix::from_diagonal(&DVector::from_column_slice(&variances));
        Self { links: nearest(&robot.base, &covariance, &robot.geometry) }
    }

    /// A robot like the reference robot: masses, centres, extents and all of friction up
    /// to 15 % off, so that rigid links have its base parameters.
    ///
    /// Like the reference robot it has its third link's centre in line and no third rotor.
    pub fn true_robot(&self, rng: &mut Rng) -> Robot<f64> {
        let mut robot = reference_robot::<f64>();
        for friction in &mut robot.friction {
            *friction = scaled_friction(friction, || off(rng));
        }
        let drawn = (0..ATTEMPTS).find_map(|_| {
            let base = self.base(rng);
            Robot { base, ..robot }.checked().ok()
        });
        drawn.unwrap_or(robot)
    }

    fn base(&self, rng: &mut Rng) -> BaseParameters<f64> {
        let reference = reference_robot::<f64>();
        let Some(physical) = &self.links else { return reference.base };
        let links = physical.links.map(|link| scaled_link(&link, || off(rng)));
        let rotors = physical.rotor_inertia_kg_m2.map(|inertia| inertia * off(rng));
        let base = base_parameters(&links, &rotors, &reference.geometry);
        BaseParameters { my3r: 0.0, ia3: 0.0, ..base }
    }
}

impl Default for RobotGenerator {
    fn default() -> Self {
        Self::new()
    }
}

fn off(rng: &mut Rng) -> f64 {
    rng.uniform(1.0 - ROBOT_SPREAD, 1.0 + ROBOT_SPREAD)
}

/// A link of another mass and other extents along its axes: what is physical stays so.
fn scaled_link(link: &Link<f64>, mut factor: impl FnMut() -> f64) -> Link<f64> {
    let mass = factor();
    let extent = Vector3::from_fn(|_, _| factor().sqrt());
    let [xx, yy, zz] = link.inertia_diagonal_kg_m2;
    let [xy, xz, yz] = link.inertia_products_kg_m2;
    let inertia = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    let moments = Matrix3::identity() * (0.5 * inertia.trace()) - inertia;
    let stretch = Matrix3::from_diagonal(&extent);
    let moments = stretch * moments * stretch * mass;
    let inertia = Matrix3::identity() * moments.trace() - moments;
    Link {
        mass_kg: link.mass_kg * mass,
        centre_m: link.centre_m.map(|centre| centre * factor()),
        inertia_diagonal_kg_m2: [0, 1, 2].map(|i| inertia[(i, i)]),
        inertia_products_kg_m2: [inertia[(0, 1)], inertia[(0, 2)], inertia[(1, 2)]],
    }
}

fn scaled_friction(friction: &Friction<f64>, mut factor: impl FnMut() -> f64) -> Friction<f64> {
    Friction {
        alpha0_v: friction.alpha0_v * factor(),
        alpha1_v: friction.alpha1_v * factor(),
        stribeck_velocity_rad_per_s: friction.stribeck_velocity_rad_per_s * factor(),
        alpha2_v_s_per_rad: friction.alpha2_v_s_per_rad * factor(),
        sigma0_v_per_rad: friction.sigma0_v_per_rad * factor(),
        sigma1_v_s_per_rad: friction.sigma1_v_s_per_rad * factor(),
    }
}

/// What identification made of a robot: each parameter 2 % off, normally distributed.
pub fn nominal_model(truth: &Robot<f64>, rng: &mut Rng) -> Robot<f64> {
    (0..ATTEMPTS).find_map(|_| model_off(truth, MODEL_ERROR, rng)).unwrap_or(*truth)
}

/// A model each of whose base and friction parameters is off by a relative standard deviation;
/// `None` where no rigid body has what was drawn.
pub fn model_off(truth: &Robot<f64>, deviation: f64, rng: &mut Rng) -> Option<Robot<f64>> {
    let mut factor = || 1.0 + deviation * rng.normal_within(MODEL_ERROR_LIMIT);
    let base = BaseParameters::from_array(truth.base.to_array().map(|p| p * factor()));
    let friction = truth.friction.map(|friction| scaled_friction(&friction, &mut factor));
    Robot { base, friction, ..*truth }.checked().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn true_robots_differ_from_the_reference_robot_and_from_one_another() {
        let generator = RobotGenerator::new();
        assert!(generator.links.as_ref().is_some_and(|links| links.distance < 0.2));
        let robots: Vec<_> =
            (0..20).map(|case| generator.true_robot(&mut Rng::new(1, case))).collect();
        let reference = reference_robot::<f64>();
        for robot in &robots {
            assert!(robot.checked().is_ok());
            let ratio = robot.base.zz3r / reference.base.zz3r;
            assert!((0.6..1.6).contains(&ratio) && ratio != 1.0, "{ratio}");
        }
        assert!(robots[0] != robots[1]);
    }

    #[test]
    fn nominal_models_are_a_few_per_cent_off() {
        let truth = RobotGenerator::new().true_robot(&mut Rng::new(1, 1));
        let nominal = nominal_model(&truth, &mut Rng::new(1, 2));
        for (nominal, truth) in nominal.base.to_array().into_iter().zip(truth.base.to_array()) {
            assert!((nominal - truth).abs() <= 0.05 * truth.abs() + 1e-15, "{nominal} {truth}");
        }
        assert!(nominal != truth);
    }
}
