//! What the refit alone moved: which parameters of the model, by how much, with which share.

use nalgebra::DVector;

use crate::fit::linearisation::Linearisation;
use crate::fit::unknowns::Unknown;
use crate::logs::subject::Subject;
use crate::result::ParameterChange;

/// The least part of what single parameters gain that all must gain together, or shares of it mean nothing.
const LEAST_WHOLE: f64 = 0.1;

/// Parameters that the refit moved by more than chance and that take a part of the squares between
/// the model as given and refitted, largest share first.
///
/// The squares that go from given to refitted are a sum over the parameters, by the slopes of the
/// refitted model: for r the refitted residual and d = -J (found - given) what setting back adds,
/// they are d (2 r + d), and each column of J has its term of d in it.
///
/// What gears take is told as the model with all causes has it: without a load, say, all that it adds seems theirs.
pub fn parameters_changed(
    subject: &Subject,
    refitted: &Linearisation,
    last: &Linearisation,
) -> Vec<ParameterChange> {
    let criteria = &subject.criteria.verdict;
    let taken = refitted.squares_by_parameter();
    let whole: f64 = taken.iter().sum();
    // By slopes of where it ended a refit may seem to gain next to nothing, of which there is no part.
    let gained: f64 = taken.iter().filter(|part| **part > 0.0).sum();
    if whole <= LEAST_WHOLE * gained {
        return Vec::new();
    }
    let change = |place: usize| {
        let expected = &refitted.expected[place];
        let (told_by, at) = match expected.unknown {
            Unknown::GearLoss => (last, last.place_of(Unknown::GearLoss)?),
            _ => (refitted, place),
        };
        let found = expected.unknown.get(&told_by.hypothesis);
        let half = 1.96 * told_by.deviation(at);
        // Where others take some of it back, one may gain more than all together.
        let share = (taken[place] / whole).min(1.0);
        let is_sure = (found - expected.mean).abs() > criteria.sure_half_widths * half;
        let parameter = name(subject, expected.unknown)?;
        (is_sure && share >= criteria.least_parameter_share).then_some(ParameterChange {
            parameter,
            given: expected.mean,
            is_given: is_given(subject, expected.unknown),
            found,
            interval: [found - half, found + half],
            share,
        })
    };
    let mut all: Vec<ParameterChange> = (0..taken.len()).filter_map(change).collect();
    all.sort_by(|a, b| b.share.total_cmp(&a.share));
    all
}

/// Whether the model tells a parameter: that of an arm may say nothing of friction, or nothing of its bristles.
fn is_given(subject: &Subject, unknown: Unknown) -> bool {
    match unknown {
        Unknown::Friction { joint, parameter } => subject.friction_told[joint][parameter],
        _ => true,
    }
}

/// A parameter's name: in the model file, or `gears.loss`, which that holds as effects; none for what it does not hold.
pub(super) fn name(subject: &Subject, unknown: Unknown) -> Option<String> {
    match unknown {
        Unknown::Base(place) => Some(subject.base_name(place)),
        Unknown::Friction { joint, parameter } => {
            let place = subject.joints.iter().position(|of| *of == joint)?;
            let number = subject.numbers[place];
            Some(format!("friction[{number}].{}", subject.friction_name(joint, parameter)))
        }
        Unknown::GearLoss => Some("gears.loss".into()),
        _ => None,
    }
}

impl Linearisation {
    /// Squares of train rows that go with each open parameter from its expectation to its value.
    fn squares_by_parameter(&self) -> Vec<f64> {
        let moved = |place: usize| {
            let expected = &self.expected[place];
            expected.unknown.get(&self.hypothesis) - expected.mean
        };
        let mut taken = vec![0.0; self.expected.len()];
        for slopes in self.joints.iter() {
            let rows = self.train[slopes.joint];
            let matrix = slopes.matrix.rows_range(..rows);
            let own: Vec<f64> = slopes.places.iter().map(|&place| moved(place)).collect();
            let change = -(matrix * DVector::from_vec(own.clone()));
            let residual = DVector::from_column_slice(&self.residual[slopes.joint][..rows]);
            let products = matrix.tr_mul(&(2.0 * residual + change));
            for ((&place, own), product) in slopes.places.iter().zip(own).zip(products.iter()) {
                taken[place] -= own * product;
            }
        }
        taken
    }
}
