//! Random robots that could be built: every link is a handful of point masses.

use model::links::{Link, base_parameters};
use model::{BaseParameters, Geometry};
use nalgebra::{Matrix3, Vector3};
use proptest::array::{uniform3, uniform6};
use proptest::prelude::*;

/// Links, rotors and lengths.
#[derive(Clone, Copy, Debug)]
pub struct RigidRobot {
    pub links: [Link<f64>; 3],
    pub rotor_inertia_kg_m2: [f64; 3],
    pub geometry: Geometry<f64>,
}

impl RigidRobot {
    pub fn base(&self) -> BaseParameters<f64> {
        base_parameters(&self.links, &self.rotor_inertia_kg_m2, &self.geometry)
    }
}

/// Angles, velocities and accelerations of the three joints.
#[derive(Clone, Copy, Debug)]
pub struct State {
    pub q_rad: [f64; 3],
    pub qd_rad_per_s: [f64; 3],
    pub qdd_rad_per_s2: [f64; 3],
}

pub fn rigid_robot() -> impl Strategy<Value = RigidRobot> {
    (uniform3(link()), uniform3(1e-4..0.1), geometry()).prop_map(
        |(links, rotor_inertia_kg_m2, geometry)| RigidRobot {
            links,
            rotor_inertia_kg_m2,
            geometry,
        },
    )
}

/// A state within the speeds of the real arm, representable in `f32`.
pub fn state() -> impl Strategy<Value = State> {
    let per_joint = |limit: f32| uniform3(-limit..limit).prop_map(|x| x.map(f64::from));
    (per_joint(6.3), per_joint(6.0), per_joint(60.0)).prop_map(
        |(q_rad, qd_rad_per_s, qdd_rad_per_s2)| State { q_rad, qd_rad_per_s, qdd_rad_per_s2 },
    )
}

fn geometry() -> impl Strategy<Value = Geometry<f64>> {
    let offset = -0.5..0.5;
    let length = 0.0..0.6;
    (uniform3(offset), [length.clone(), length]).prop_map(|([d1_m, d2_m, d3_m], [a2_m, a3_m])| {
        Geometry { gravity_m_s2: 9.81, d1_m, d2_m, a2_m, d3_m, a3_m }
    })
}

pub fn link() -> impl Strategy<Value = Link<f64>> {
    let point = (0.05..2.0, uniform3(-0.3..0.3));
    uniform6(point).prop_map(|points| link_of_points(&points))
}

/// The rigid body that six point masses (mass, position) make.
fn link_of_points(points: &[(f64, [f64; 3]); 6]) -> Link<f64> {
    let mass_kg = points.iter().map(|(mass, _)| mass).sum();
    let moment: Vector3<f64> = points.iter().map(|(mass, at)| Vector3::from(*at) * *mass).sum();
    let centre = moment / mass_kg;
    let inertia: Matrix3<f64> =
        points.iter().map(|(mass, at)| point_inertia(*mass, Vector3::from(*at) - centre)).sum();
    Link {
        mass_kg,
        centre_m: centre.into(),
        inertia_diagonal_kg_m2: inertia.diagonal().into(),
        inertia_products_kg_m2: [inertia[(0, 1)], inertia[(0, 2)], inertia[(1, 2)]],
    }
}

fn point_inertia(mass: f64, r: Vector3<f64>) -> Matrix3<f64> {
    (Matrix3::identity() * r.norm_squared() - r * r.transpose()) * mass
}
