//! What is thought of a link before the logs are seen.

use files::ArmJoint;
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

/// Where a link reaches: half way to the next joint [m], and its length [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// The middle of the link in its frame.
    pub middle_m: [f64; 3],
    /// Its length.
    pub length_m: f64,
}

/// The mass of a link of which nothing is known [kg]; its standard deviation is a factor of ten.
const UNKNOWN_MASS_KG: f64 = 1.0;
/// Radius of gyration about each plane of an unknown link, by its length.
const UNKNOWN_RADIUS: f64 = 0.3;
/// Doubt of an exact value, for the search alone.
const EXACT: f64 = 1e-5;

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
            given: given(joint, mass, reach, settings),
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

/// The values that the file gives, with their standard deviations.
fn given(
    joint: &ArmJoint,
    mass: f64,
    reach: &Reach,
    settings: &Settings,
) -> Vec<(usize, f64, f64)> {
    let link = &joint.link;
    let inertia = link.inertia_kg_m2.unwrap_or_default();
    let half_trace = (inertia[0] + inertia[3] + inertia[5]) / 2.0;
    let square = link.com_m.unwrap_or_default().iter().map(|x| x * x).sum::<f64>();
    // A point that is a link has the doubt of one a tenth of its length wide.
    let radius = (square + half_trace / mass).sqrt().max(0.1 * reach.length_m);
    let scales = [mass, radius, half_trace.max(mass * (0.1 * reach.length_m).powi(2))];
    let mut found = Vec::new();
    let mut add = |name: &str, first: usize, values: &[f64], scale: f64| {
        let errors = joint.standard_error(name);
        for (k, value) in values.iter().enumerate() {
            let doubt = match errors.and_then(|errors| errors.get(k)) {
                Some(error) => error.max(EXACT * scale),
                None => settings.doubt_of_link * scale,
            };
            found.push((first + k, *value, doubt));
        }
    };
    link.mass_kg.iter().for_each(|mass| add("mass_kg", 0, &[*mass], scales[0]));
    link.com_m.iter().for_each(|centre| add("com_m", 1, centre, scales[1]));
    link.inertia_kg_m2.iter().for_each(|inertia| add("inertia_kg_m2", 4, inertia, scales[2]));
    found
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

/// The reach of every link: to the next joint, or the last as far as the one before.
pub fn reaches(joints: &[ArmJoint]) -> Vec<Reach> {
    /// No link is shorter [m].
    const SHORTEST_M: f64 = 0.05;
    /// Nor longer [m].
    const LONGEST_M: f64 = 100.0;
    let length = |joint: &ArmJoint| {
        let square: f64 = joint.origin_xyz_m.iter().map(|x| x * x).sum();
        square.sqrt().clamp(SHORTEST_M, LONGEST_M)
    };
    (0..joints.len())
        .map(|index| match joints.get(index + 1) {
            Some(next) => {
                Reach { middle_m: next.origin_xyz_m.map(|x| x / 2.0), length_m: length(next) }
            }
            None => Reach { middle_m: [0.0; 3], length_m: length(&joints[index]) },
        })
        .collect()
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
