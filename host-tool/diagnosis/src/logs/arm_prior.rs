//! A chain in the coordinates that its torques show, and how far each may be from the model as given.

use files::{ArmFile, ArmJoint};
use mechanism::{BaseParameters, Reach, given_values, reaches};
use model::chain::{BODY_PARAMETERS, Body, LINK_PARAMETERS, SerialChain};
use model::mechanism::Mechanism;
use nalgebra::{Cholesky, DMatrix, DVector};
use rig::plant::{Directions, LinkedBody};

/// A chain by its base parameters, each as the change of one link's parameter that stands for all, and
/// their standard deviations, from the doubts of all links' values; a value without a standard
/// error is off by `doubt` in parts of it.
pub fn linked(arm: &ArmFile, chain: SerialChain<f64>, doubt: f64) -> (LinkedBody, LinkSpread) {
    let base = BaseParameters::of(&chain, &mechanism::Settings::default());
    let mut parameters = vec![0.0; chain.parameter_count()];
    chain.parameters(&mut parameters);
    let names = base.columns().into_iter().map(|column| {
        let name = chain.parameter_name(column);
        format!("{name}")
    });
    let directions = Directions {
        names: names.collect(),
        terms: base.columns().into_iter().map(|column| vec![(column, 1.0)]).collect(),
    };
    let at = base.values(&parameters);
    let spread = LinkSpread::of(arm, &chain, &base, doubt);
    (LinkedBody::new(chain, directions, at), spread)
}

/// How far base parameters move with the values of links.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LinkSpread {
    /// By link value: the link, which of its values, its standard deviation, and what that moves.
    moves: Vec<Move>,
    /// Standard deviations of base parameters that the file tells.
    told: Vec<Option<f64>>,
}

/// What one link value moves.
#[derive(Clone, Debug, PartialEq)]
struct Move {
    link: usize,
    /// Mass, centre of mass (3), inertia about it (6), rotor.
    value: usize,
    deviation: f64,
    /// Whether the file tells that deviation.
    is_told: bool,
    /// Base parameters by so much with one deviation.
    by: Vec<f64>,
}

impl LinkSpread {
    fn of(arm: &ArmFile, chain: &SerialChain<f64>, base: &BaseParameters, doubt: f64) -> Self {
        let reaches = reaches(&arm.joints);
        let mut moves = Vec::new();
        for (link, (joint, reach)) in arm.joints.iter().zip(&reaches).enumerate() {
            for (value, deviation, change) in changes(joint, reach, inertia(chain, link), doubt) {
                let mut all = vec![0.0; chain.parameter_count()];
                all[LINK_PARAMETERS * link..][..LINK_PARAMETERS].copy_from_slice(&change);
                let (is_told, by) = (is_told(joint, value), base.values(&all));
                moves.push(Move { link, value, deviation, is_told, by });
            }
        }
        let told = base.combinations.iter().map(|sum| told(arm, &sum.to_string()));
        Self { moves, told: told.collect() }
    }

    /// Standard deviations of base parameters: as the file tells them, or those of all links' values.
    pub fn deviations(&self) -> Vec<f64> {
        let by_links = self.by_links().into_iter();
        let both = by_links.zip(&self.told).map(|(by_links, told)| told.unwrap_or(by_links));
        not_none(both.collect())
    }

    /// Standard deviations of base parameters as those of all links' values leave them, whatever the file tells of sums.
    pub fn by_links(&self) -> Vec<f64> {
        let count = self.moves.first().map_or(0, |of_value| of_value.by.len());
        let variance =
            |k: usize| self.moves.iter().map(|of_value| of_value.by[k].powi(2)).sum::<f64>();
        not_none((0..count).map(|k| variance(k).sqrt()).collect())
    }

    /// Multiplies the deviations that the file does not tell.
    pub fn widen(&mut self, factor: f64) {
        for of_value in self.moves.iter_mut().filter(|of_value| !of_value.is_told) {
            of_value.deviation *= factor;
            of_value.by.iter_mut().for_each(|by| *by *= factor);
        }
    }

    /// The likeliest change of link values that changes the base parameters so: link, value, change.
    pub fn likeliest(&self, base_change: &[f64]) -> Vec<(usize, usize, f64)> {
        let count = base_change.len();
        let by = DMatrix::from_fn(count, self.moves.len(), |k, v| self.moves[v].by[k]);
        let mut covariance = &by * by.transpose();
        let little = 1e-9 * covariance.diagonal().max();
        (0..count).for_each(|k| covariance[(k, k)] += little.max(f64::MIN_POSITIVE));
        let Some(factors) = Cholesky::new(covariance) else { return Vec::new() };
        let pull = by.tr_mul(&factors.solve(&DVector::from_column_slice(base_change)));
        let both = self.moves.iter().zip(pull.iter());
        both.map(|(of, pull)| (of.link, of.value, of.deviation * pull)).collect()
    }
}

/// Deviations of which none is nothing: what is exact may yet be off by rounding.
fn not_none(deviations: Vec<f64>) -> Vec<f64> {
    let least = 1e-6 * deviations.iter().copied().fold(0.0, f64::max);
    deviations.into_iter().map(|deviation| deviation.max(least)).collect()
}

/// The standard error of a base parameter that a file tells.
fn told(arm: &ArmFile, name: &str) -> Option<f64> {
    let of_name = arm.base_errors.iter().find(|error| error.name == name);
    of_name.map(|error| error.standard_error)
}

/// Whether a file tells the standard error of a link's value.
fn is_told(joint: &ArmJoint, value: usize) -> bool {
    let name = match value {
        0 => "mass_kg".to_owned(),
        1..=3 => "com_m".to_owned(),
        BODY_PARAMETERS => joint.armature_name(),
        _ => "inertia_kg_m2".to_owned(),
    };
    joint.standard_error(&name).is_some()
}

/// Inertia that a joint feels where all stand at zero.
fn inertia(chain: &SerialChain<f64>, joint: usize) -> f64 {
    let count = Mechanism::joints(chain);
    let mut mass = vec![0.0; count * count];
    chain.mass_matrix(&vec![0.0; count], &mut mass);
    mass[joint * count + joint]
}

/// By how much a link's parameters change with one standard deviation of each of its values.
fn changes(
    joint: &ArmJoint,
    reach: &Reach,
    inertia: f64,
    doubt: f64,
) -> Vec<(usize, f64, [f64; LINK_PARAMETERS])> {
    let link = &joint.link;
    let mass = link.mass_kg.unwrap_or(0.0).max(1e-9);
    let centre = link.com_m.unwrap_or_default();
    let about = link.inertia_kg_m2.unwrap_or_default();
    let parameters = |values: &[f64; BODY_PARAMETERS]| {
        let [mass, x, y, z, inertia @ ..] = *values;
        Body::about_centre(mass, [x, y, z], inertia).to_array()
    };
    let mut given = [0.0; BODY_PARAMETERS];
    given[0] = mass;
    given[1..4].copy_from_slice(&centre);
    given[4..].copy_from_slice(&about);
    let as_given = parameters(&given);
    let of_value = |(k, _, deviation): (usize, f64, f64)| {
        let mut moved = given;
        moved[k] += deviation;
        let mut change = [0.0; LINK_PARAMETERS];
        for (change, (to, from)) in change.iter_mut().zip(parameters(&moved).iter().zip(as_given)) {
            *change = to - from;
        }
        (k, deviation, change)
    };
    let mut all: Vec<_> =
        given_values(joint, mass, reach, doubt).into_iter().map(of_value).collect();
    let mut rotor = [0.0; LINK_PARAMETERS];
    let deviation = rotor_deviation(joint, inertia, doubt);
    rotor[BODY_PARAMETERS] = deviation;
    all.push((BODY_PARAMETERS, deviation, rotor));
    all
}

/// Standard deviation of a rotor; one that is not given counts as none.
fn rotor_deviation(joint: &ArmJoint, inertia: f64, doubt: f64) -> f64 {
    let error = joint.standard_error(&joint.armature_name()).and_then(|errors| errors.first());
    match (error, joint.armature) {
        (Some(error), _) => *error,
        (None, Some(armature)) => doubt * armature,
        (None, None) => doubt * inertia,
    }
}

#[cfg(test)]
mod tests {
    use files::arm_file::BaseError;
    use files::example_arms::two_link_pendulum;

    use super::*;

    #[test]
    fn a_sum_whose_error_is_told_is_known_so_well_and_others_as_their_links_are() {
        let mut arm = two_link_pendulum();
        let chain = arm.chain().unwrap();
        let (_, by_links) = linked(&arm, chain, 0.1);
        let base = BaseParameters::of(&chain, &mechanism::Settings::default());
        let name = base.combinations[1].to_string();
        arm.base_errors = vec![
            BaseError { name, standard_error: 1e-4 },
            BaseError { name: "joint[9].mx_kg_m".to_owned(), standard_error: 1.0 },
        ];
        let (_, told) = linked(&arm, chain, 0.1);
        let (before, after) = (by_links.deviations(), told.deviations());
        assert!(before[1] > 1e-3, "{before:?}");
        for (k, (before, after)) in before.iter().zip(&after).enumerate() {
            let expected = if k == 1 { 1e-4 } else { *before };
            assert!((after - expected).abs() < 1e-12, "{k}: {after} {expected}");
        }
    }
}
