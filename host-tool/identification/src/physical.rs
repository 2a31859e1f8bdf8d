//! Rigid links that have the identified base parameters.
//!
//! Least squares does not keep masses positive. Base parameters are physical when three rigid
//! links with their rotors have them: masses above zero, central inertia tensors whose
//! main moments satisfy the triangle inequality, rotors of zero or more. The nearest such
//! parameters, in the metric of the estimates' covariance, are found over all links by
//! Levenberg-Marquardt; links are parametrised by the logarithm of their mass, their
//! centre, and the Cholesky factor (with logarithmic diagonal) of their second moments
//! about it, so that every point of the search is physical (Rucker and Wensing 2022).

use model::links::{Link, base_parameters};
use model::{BaseParameters, Geometry};
use nalgebra::{DMatrix, DVector, Matrix3};

use signal::estimation::{NonlinearSettings, minimise};

/// Parameters of a link.
const LINK_COUNT: usize = 10;
/// Parameters of the search: link 1 as a sphere, links 2 and 3, rotors of joints 2 and 3.
const COUNT: usize = 2 * LINK_COUNT + 3;

/// The physical base parameters nearest to an estimate.
#[derive(Clone, Debug, PartialEq)]
pub struct Physical {
    /// The parameters.
    pub base: BaseParameters<f64>,
    /// Links that have them; among many such sets, one of moderate masses.
    pub links: [Link<f64>; 3],
    /// Rotor inertias that go with the links [kg m^2].
    pub rotor_inertia_kg_m2: [f64; 3],
    /// Distance from the estimate in standard deviations: the root of d^T C^-1 d.
    pub distance: f64,
    /// Whether the estimate's errors explain the distance.
    pub consistent: bool,
    /// Whether D is positive definite in every posture.
    pub positive_definite: bool,
}

/// Distance that chance exceeds once in a hundred times, chi squared of 16.
const LIKELY_DISTANCE: f64 = 5.657;
/// Weight of moderate links against a standard deviation of the estimate.
const REGULARISER: f64 = 1e-3;

/// The physical base parameters nearest to `base`, whose covariance is `covariance`.
///
/// `None` where the covariance is not positive definite or the search fails. Take the
/// result in the estimate's place only where `consistent` says so: an estimate far from
/// all rigid links speaks of errors that its covariance does not know, or of a robot that
/// is more than rigid links, and either way predicts motion better than the nearest links.
pub fn nearest(
    base: &BaseParameters<f64>,
    covariance: &DMatrix<f64>,
    geometry: &Geometry<f64>,
) -> Option<Physical> {
    let target = DVector::from_column_slice(&base.to_array());
    let start = starting_links(base, geometry);
    let mut x = start.clone();
    // From a coarse metric to the true one: far away, the narrow valleys of a precise
    // estimate are hard to follow.
    for blur in [1e-1, 1e-2, 1e-3, 0.0] {
        let whitener = whitener(covariance, &target, blur)?;
        let residuals = |x: &[f64]| residuals(x, &start, &target, &whitener, geometry);
        let settings = NonlinearSettings { patience: 10, ..NonlinearSettings::default() };
        x = minimise(residuals, &x, &[1.0; COUNT], &settings)?.parameters;
    }
    let (links, rotors) = links_of(&x);
    let found = base_parameters(&links, &rotors, geometry);
    let difference = DVector::from_column_slice(&found.to_array()) - &target;
    let distance = (whitener(covariance, &target, 0.0)? * difference).norm();
    Some(Physical {
        base: found,
        links,
        rotor_inertia_kg_m2: rotors,
        distance,
        consistent: distance < LIKELY_DISTANCE,
        positive_definite: found.check(geometry).is_ok(),
    })
}

/// W with W^T W = C^-1, the deviations first widened by `blur` of the parameters' size.
fn whitener(covariance: &DMatrix<f64>, target: &DVector<f64>, blur: f64) -> Option<DMatrix<f64>> {
    let size = target.amax().max(1e-6);
    let widened =
        covariance + DMatrix::identity(target.len(), target.len()) * (blur * size).powi(2);
    widened.cholesky()?.l().try_inverse()
}

fn residuals(
    x: &[f64],
    start: &[f64],
    target: &DVector<f64>,
    whitener: &DMatrix<f64>,
    geometry: &Geometry<f64>,
) -> Option<Vec<f64>> {
    let (links, rotors) = links_of(x);
    let found = base_parameters(&links, &rotors, geometry).to_array();
    let white = whitener * (DVector::from_column_slice(&found) - target);
    let moderate = x.iter().zip(start).map(|(x, start)| REGULARISER * (x - start));
    let all: Vec<f64> = white.iter().copied().chain(moderate).collect();
    all.iter().all(|r| r.is_finite()).then_some(all)
}

/// The links and rotors of a point of the search.
fn links_of(x: &[f64]) -> ([Link<f64>; 3], [f64; 3]) {
    // Base parameters know of link 1 only the inertia about its joint, within zz1r.
    let inertia_1 = x[2 * LINK_COUNT].powi(2);
    let link1 = Link {
        mass_kg: 1.0,
        centre_m: [0.0; 3],
        inertia_diagonal_kg_m2: [inertia_1; 3],
        inertia_products_kg_m2: [0.0; 3],
    };
    let rotors = [0.0, x[2 * LINK_COUNT + 1].powi(2), x[2 * LINK_COUNT + 2].powi(2)];
    ([link1, link_of(&x[..LINK_COUNT]), link_of(&x[LINK_COUNT..])], rotors)
}

/// A link of ten parameters; any ten give a link that can be built.
fn link_of(x: &[f64]) -> Link<f64> {
    let factor = Matrix3::new(x[4].exp(), 0.0, 0.0, x[5], x[6].exp(), 0.0, x[7], x[8], x[9].exp());
    // Second moments: the integral of r r^T dm; the inertia tensor is tr(S) 1 - S.
    let moments = factor * factor.transpose();
    let trace = moments.trace();
    Link {
        mass_kg: x[0].exp(),
        centre_m: [x[1], x[2], x[3]],
        inertia_diagonal_kg_m2: [0, 1, 2].map(|i| trace - moments[(i, i)]),
        inertia_products_kg_m2: [-moments[(0, 1)], -moments[(0, 2)], -moments[(1, 2)]],
    }
}

/// Where the search begins: compact links with the moments and inertias asked for.
fn starting_links(base: &BaseParameters<f64>, geometry: &Geometry<f64>) -> Vec<f64> {
    let offset = geometry.d2_m + geometry.d3_m;
    let link3 = compact_link(base.mx3r, base.my3r, base.zz3r, base.xz3r, geometry.a3_m, offset);
    let m3 = link3[0].exp();
    let inertia_2 = base.zz2r - geometry.a2_m.powi(2) * m3;
    let mx2 = base.mx2r - geometry.a2_m * m3;
    let link2 = compact_link(mx2, base.my2r, inertia_2, base.xz2r, geometry.a2_m, geometry.d2_m);
    let rest = [base.zz1r.abs().sqrt() * 0.5, 0.03, base.ia3.abs().sqrt().max(0.01)];
    [&link2[..], &link3[..], &rest[..]].concat()
}

/// A link with first moments about its joint, of which Steiner's part is half the inertia.
fn compact_link(mx: f64, my: f64, inertia: f64, xz: f64, length_m: f64, offset_m: f64) -> Vec<f64> {
    let inertia = inertia.abs().max(1e-4);
    let moment = mx.hypot(my).max(1e-3);
    let mass = 2.0 * moment * moment / inertia;
    let z = if mx.abs() > 1e-3 { -xz / mx - offset_m } else { 0.0 };
    let half = (0.25 * inertia).sqrt().ln();
    vec![mass.ln(), mx / mass - length_m, my / mass, z, half, 0.0, half, 0.0, 0.0, half]
}

#[cfg(test)]
mod tests {
    use model::base::NAMES;
    use model::reference_robot::reference_robot;

    use super::*;

    /// A covariance of independent errors of a per cent of each parameter's size.
    fn covariance(base: &BaseParameters<f64>, share: f64) -> DMatrix<f64> {
        let deviations = base.to_array().map(|p| share * p.abs().max(0.01));
        DMatrix::from_diagonal(&DVector::from_iterator(16, deviations.into_iter().map(|d| d * d)))
    }

    #[test]
    fn the_reference_robot_has_links() {
        let robot = reference_robot::<f64>();
        for share in [1e-2, 1e-3, 1e-4] {
            let found =
                nearest(&robot.base, &covariance(&robot.base, share), &robot.geometry).unwrap();
            assert!(found.distance < 0.2, "{share}: {}", found.distance);
            assert!(found.consistent && found.positive_definite);
            let rebuilt =
                base_parameters(&found.links, &found.rotor_inertia_kg_m2, &robot.geometry);
            assert_eq!(rebuilt, found.base);
        }
    }

    #[test]
    fn impossible_parameters_move_to_the_nearest_links() {
        let robot = reference_robot::<f64>();
        let mut base = robot.base;
        // Link 3's inertia about its joint below what its own x and z extents allow.
        base.zz3r = 0.8 * -base.xx3r;
        let found = nearest(&base, &covariance(&base, 1e-2), &robot.geometry).unwrap();
        assert!(found.distance > LIKELY_DISTANCE && !found.consistent, "{}", found.distance);
        assert!(found.base.zz3r > -found.base.xx3r);
        for (k, name) in NAMES.into_iter().enumerate() {
            let (a, b) = (base.to_array()[k], found.base.to_array()[k]);
            assert!((a - b).abs() < 0.02, "{name}: {a} to {b}");
        }
    }

    #[test]
    fn every_link_of_the_search_can_be_built() {
        let x: Vec<f64> = (0..10).map(|k| (f64::from(k) * 1.7).sin()).collect();
        let link = link_of(&x);
        let [xx, yy, zz] = link.inertia_diagonal_kg_m2;
        let [xy, xz, yz] = link.inertia_products_kg_m2;
        let moments = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz).symmetric_eigenvalues();
        assert!(link.mass_kg > 0.0 && moments.min() > 0.0);
        assert!(2.0 * moments.max() < moments.sum(), "triangle inequality");
    }
}
