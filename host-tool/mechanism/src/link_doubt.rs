//! What a file says of a link, and how far each of its values may be off.

use files::ArmJoint;

/// Where a link reaches: half way to the next joint [m], and its length [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// The middle of the link in its frame.
    pub middle_m: [f64; 3],
    /// Its length.
    pub length_m: f64,
}

/// Doubt of an exact value, in parts of its kind's, for searches alone.
const EXACT: f64 = 1e-5;

/// The values of a link that a file gives, with their standard deviations: index into mass, centre
/// of mass (3) and inertia about it (6), value, deviation.
///
/// A value without a standard error is off by `doubt` in parts of it, mass and inertia, or of the
/// link's size, the centre of mass. `mass` counts where the file gives none.
pub fn given_values(
    joint: &ArmJoint,
    mass: f64,
    reach: &Reach,
    doubt: f64,
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
                None => doubt * scale,
            };
            found.push((first + k, *value, doubt));
        }
    };
    link.mass_kg.iter().for_each(|mass| add("mass_kg", 0, &[*mass], scales[0]));
    link.com_m.iter().for_each(|centre| add("com_m", 1, centre, scales[1]));
    link.inertia_kg_m2.iter().for_each(|inertia| add("inertia_kg_m2", 4, inertia, scales[2]));
    found
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
