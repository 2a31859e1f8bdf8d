//! From a campaign to a refitted model on rows that are white.

use super::evidence::Evidence;
use super::fit::{MOST_STEPS, fit};
use super::linearisation::Linearisation;
use super::noise::Noise;
use super::selection::Selection;
use super::stretch::Stretch;
use super::subject::Subject;
use super::voltage::{Added, Point, Trial};

/// Steps of the first fit, which only serves to see the noise.
const FIRST_STEPS: usize = 2;

/// The rows, and the model retuned to those of train logs; `None` where the numbers do not
/// work out.
pub fn prepared(subject: &Subject, stretches: Vec<Stretch>) -> Option<(Evidence, Linearisation)> {
    let given = as_given(subject);
    let noise = noise(&stretches, &given)?;
    let evidence = Evidence::new(stretches, subject.joints.clone(), noise);
    let rough = fit(&evidence, subject, given, FIRST_STEPS)?;
    let noise = self::noise(&evidence.stretches, &rough.point)?;
    let evidence = Evidence::new(evidence.stretches, subject.joints.clone(), noise);
    let linear = fit(&evidence, subject, rough.point, MOST_STEPS)?;
    Some((evidence, linear))
}

/// Noise in what the last model of a selection leaves: a gap that is always there passes for
/// noise until its cause is found.
pub fn noise_left(evidence: &Evidence, selection: &Selection) -> [Noise; 3] {
    let last = selection.steps.last();
    let found = last.and_then(|step| noise(&evidence.stretches, &step.linear.point));
    found.unwrap_or(evidence.noise)
}

/// The model as given.
pub fn as_given(subject: &Subject) -> Point {
    let effects = subject.known_effects.iter().map(|(definition, joint, values)| Added {
        definition,
        joint: *joint,
        values: values.clone(),
    });
    Point { robot: subject.robot, lag_s: [0.0; 3], effects: effects.collect() }
}

/// Noise of each joint in what a model leaves of logs without driven noise, or of all logs
/// where there are no others.
fn noise(stretches: &[Stretch], point: &Point) -> Option<[Noise; 3]> {
    let calm: Vec<&Stretch> = stretches.iter().filter(|s| !s.brisk).collect();
    let used = if calm.is_empty() { stretches.iter().collect() } else { calm };
    let period_s = used.first()?.period_s;
    let of_joint = |joint: usize| {
        let left: Vec<Vec<f64>> =
            used.iter().map(|stretch| Trial::of(stretch, point).shortfall(joint)).collect();
        let left: Vec<&[f64]> = left.iter().map(|rows| &rows[..]).collect();
        Noise::of(&left, period_s)
    };
    let nothing = Noise { white: 1e-12, growing: 1e-18 };
    Some([0, 1, 2].map(|joint| of_joint(joint).unwrap_or(nothing)))
}
