//! What is thought of a link before the logs are seen.

use files::ArmJoint;
use mechanism::given_values;
pub use mechanism::{Reach, reaches};
use model::chain::{BODY_PARAMETERS, Body};
use nalgebra::{Matrix3, SymmetricEigen};

use super::settings::Settings;

/// Mass, centre of mass (3) and inertia about it (6), the values of a file.
pub type LinkValues = [f64; BODY_PARAMETERS];

/// A prior over a whole link, in the numbers of log-Cholesky, any of which is a possible body.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkPrior {
    /// A possible body: the given one where it is possible and whole.
    pub start: [f64; BODY_PARAMETERS],
    /// Standard deviations of those numbers, wide: ten times the mass, three times the size.
    pub width: [f64; BODY_PARAMETERS],
    /// Given values: index into [`LinkValues`], value, standard deviation.
    pub given: Vec<(usize, f64, f64)>,
}

/// The mass of a link of which nothing is known [kg]; its standard deviation is a factor of ten.
const UNKNOWN_MASS_KG: f64 = 1.0;
/// Radius of gyration about each plane of an unknown link, by its length.
const UNKNOWN_RADIUS: f64 = 0.3;
impl LinkPrior {
    /// Of a joint's link as the file gives it.
    pub fn of(joint: &ArmJoint, reach: &Reach, settings: &Settings) -> Self {
        let link = &joint.link;
        let mass = link.mass_kg.unwrap_or(UNKNOWN_MASS_KG).max(1e-4);
        let centre = link.com_m.unwrap_or(reach.middle_m);
        let round = 2.0 * mass * (UNKNOWN_RADIUS * reach.length_m).powi(2);
        let inertia = link.inertia_kg_m2.unwrap_or([round, 0.0, 0.0, round, 0.0, round]);
        let body = Body::about_centre(mass, centre, possible(mass, inertia, reach.length_m));
        let size = reach.length_m;
        let mut width = [0.3 * size; BODY_PARAMETERS];
        width[0] = 10.0_f64.ln() / 2.0;
        width[1..4].fill(3.0_f64.ln());
        width[7..].fill(size);
        Self {
            start: body.log_cholesky().unwrap_or_else(|| round_body(mass, centre, size)),
            width,
            given: given_values(joint, mass, reach, settings.doubt_of_link),
        }
    }

    /// Whether all of the link is given.
    pub fn is_given(&self) -> bool {
        self.given.len() == BODY_PARAMETERS
    }

    /// What a search is charged for a link: one entry per number and given value.
    pub fn residuals(&self, numbers: &[f64; BODY_PARAMETERS]) -> Vec<f64> {
        let values = values_of(numbers);
        let wide = (0..BODY_PARAMETERS).map(|k| (numbers[k] - self.start[k]) / self.width[k]);
        let near = self.given.iter().map(|(k, value, doubt)| (values[*k] - value) / doubt);
        wide.chain(near).collect()
    }
}

/// The numbers of an unknown link's inertia about a centre: for one so far from its joint that
/// its given inertia is lost in rounding.
fn round_body(mass: f64, [x, y, z]: [f64; 3], length_m: f64) -> [f64; BODY_PARAMETERS] {
    let radius = (UNKNOWN_RADIUS * length_m).ln();
    [mass.ln() / 2.0, radius, radius, radius, 0.0, 0.0, 0.0, x, y, z]
}

/// The values of a file that belong to the numbers of log-Cholesky.
pub fn values_of(numbers: &[f64; BODY_PARAMETERS]) -> LinkValues {
    let body = Body::of_log_cholesky(numbers);
    let centre = body.moment_kg_m.map(|moment| moment / body.mass_kg);
    let steiner = Body::point(body.mass_kg, centre).inertia_kg_m2;
    let [x, y, z] = centre;
    let i: [f64; 6] = core::array::from_fn(|k| body.inertia_kg_m2[k] - steiner[k]);
    [body.mass_kg, x, y, z, i[0], i[1], i[2], i[3], i[4], i[5]]
}

/// The nearest inertia about the centre of mass that matter can have: no second moment of the
/// mass below that of a hundredth of the link's length.
fn possible(mass: f64, inertia: [f64; 6], length_m: f64) -> [f64; 6] {
    let [xx, xy, xz, yy, yz, zz] = inertia;
    let tensor = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    let moments = Matrix3::identity() * (tensor.trace() / 2.0) - tensor;
    if !moments.iter().all(|moment| moment.is_finite()) {
        return inertia;
    }
    let mut split = SymmetricEigen::new(moments);
    let least = mass * (0.01 * length_m).powi(2);
    split.eigenvalues.apply(|moment| *moment = moment.max(least));
    let moments = split.recompose();
    let tensor = Matrix3::identity() * moments.trace() - moments;
    [tensor[(0, 0)], tensor[(0, 1)], tensor[(0, 2)], tensor[(1, 1)], tensor[(1, 2)], tensor[(2, 2)]]
}

#[cfg(test)]
mod tests {
    use files::arm_file::LinkTable;

    use super::*;

    #[test]
    fn any_given_link_has_a_possible_start() {
        let reach = Reach { middle_m: [0.1, 0.0, 0.0], length_m: 0.3 };
        let inertias = [[0.0; 6], [1.0, 0.0, 0.0, 1e-3, 0.0, 1e-3], [1e300; 6], [1e-6; 6]];
        for inertia in inertias {
            for (mass, x) in [(0.0, 0.0), (1.0, 1e7), (1e5, 1e-3), (1e-9, 1e200)] {
                let link = LinkTable {
                    mass_kg: Some(mass),
                    com_m: Some([x, 0.0, 0.0]),
                    inertia_kg_m2: Some(inertia),
                };
                let joint = ArmJoint { link, ..ArmJoint::default() };
                let prior = LinkPrior::of(&joint, &reach, &Settings::default());
                assert!(prior.start.iter().all(|number| number.is_finite()), "{joint:?}");
            }
        }
    }

    #[test]
    fn values_and_numbers_agree() {
        let given = [2.0, 0.1, -0.2, 0.05, 0.02, 1e-3, 0.0, 0.03, -2e-3, 0.025];
        let [mass, x, y, z, inertia @ ..] = given;
        let body = Body::about_centre(mass, [x, y, z], inertia);
        let found = values_of(&body.log_cholesky().unwrap());
        for (given, found) in given.iter().zip(found) {
            assert!((given - found).abs() < 1e-12, "{given} {found}");
        }
    }
}
