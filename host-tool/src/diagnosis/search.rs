//! Every effect on every joint, tried in a model.

use rayon::prelude::*;

use super::candidate::Candidate;
use super::evidence::Evidence;
use super::harmonics;
use super::linearisation::Linearisation;
use super::subject::Subject;
use super::voltage::{Added, Trial};
use crate::effects::{CATALOGUE, Definition, Search, Typical};
use crate::simulation::tracking::rms;

/// Harmonics that are followed up of those that look best.
const HARMONICS: usize = 3;
/// Steps of a first, rough search and of a thorough one.
const ROUGH_STEPS: usize = 2;
const THOROUGH_STEPS: usize = 6;
/// Starts of one effect that are searched thoroughly.
const BEST_STARTS: usize = 2;
/// Effects that gain less than this part of the best one's gain are not searched thoroughly.
const WORTH_IT: f64 = 0.3;

/// The best of every effect on every joint, the best first.
pub fn candidates(
    linear: &Linearisation,
    evidence: &Evidence,
    subject: &Subject,
) -> Vec<Candidate> {
    let places = places(subject);
    let rough: Vec<Vec<Candidate>> = places
        .par_iter()
        .map(|&(definition, joint)| rough(linear, evidence, subject, definition, joint))
        .collect();
    let best_gain = rough
        .iter()
        .flatten()
        .map(|candidate| linear.objective - candidate.score.train)
        .fold(0.0, f64::max);
    let mut found: Vec<Candidate> = rough
        .into_par_iter()
        .filter_map(|starts| thorough(linear, evidence, starts, WORTH_IT * best_gain))
        .collect();
    found.sort_by(|a, b| a.score.total().total_cmp(&b.score.total()));
    found
}

/// Effects and the joints that they can act on.
fn places(subject: &Subject) -> Vec<(&'static Definition, u8)> {
    let joints: Vec<u8> = subject.joints.iter().map(|&joint| joint as u8 + 1).collect();
    let of = |definition: &'static Definition| -> Vec<(&'static Definition, u8)> {
        match definition.whole_robot {
            true => vec![(definition, 0)],
            false => joints.iter().map(|&joint| (definition, joint)).collect(),
        }
    };
    CATALOGUE.into_iter().flat_map(of).collect()
}

/// All starts of an effect after a few steps, the best first.
fn rough(
    linear: &Linearisation,
    evidence: &Evidence,
    subject: &Subject,
    definition: &'static Definition,
    joint: u8,
) -> Vec<Candidate> {
    let values = match definition.search {
        Search::From(starts) => starts(&typical(linear, evidence, subject, joint)),
        Search::Harmonics(carrier) => {
            let joint = usize::from(joint) - 1;
            harmonics::best(linear, evidence, joint, carrier, HARMONICS)
                .into_iter()
                .map(|h| vec![h.amplitude, h.order as f64, h.phase_rad])
                .collect()
        }
    };
    let mut starts: Vec<Candidate> = values
        .into_iter()
        .map(|values| Candidate::of(linear, evidence, Added { definition, joint, values }).0)
        .map(|candidate| candidate.refined(linear, evidence, 1))
        .collect();
    starts.sort_by(|a, b| a.score.train.total_cmp(&b.score.train));
    starts.truncate(BEST_STARTS);
    starts
        .into_iter()
        .map(|candidate| candidate.refined(linear, evidence, ROUGH_STEPS - 1))
        .collect()
}

/// The best of an effect's starts, searched to the end where it is worth it.
fn thorough(
    linear: &Linearisation,
    evidence: &Evidence,
    starts: Vec<Candidate>,
    least_gain: f64,
) -> Option<Candidate> {
    starts
        .into_iter()
        .map(|start| match linear.objective - start.score.train > least_gain {
            true => start.refined(linear, evidence, THOROUGH_STEPS),
            false => start,
        })
        .min_by(|a, b| a.score.train.total_cmp(&b.score.train))
}

/// What is typical of a joint (1 to 3, or 0 for the whole robot) in these logs.
fn typical(
    linear: &Linearisation,
    evidence: &Evidence,
    subject: &Subject,
    joint: u8,
) -> Typical {
    let joint = usize::from(joint.max(1)) - 1;
    let robot = &linear.point.robot;
    let all = |signal: fn(&super::stretch::Stretch, usize) -> &[f64]| {
        evidence.stretches.iter().flat_map(move |stretch| signal(stretch, joint)).copied()
    };
    let largest = |values: &mut dyn Iterator<Item = f64>| {
        values.map(f64::abs).fold(1e-9, f64::max)
    };
    let angles: Vec<f64> = all(|s, j| &s.motion.q_rad[j]).collect();
    let load: Vec<f64> = evidence
        .stretches
        .iter()
        .flat_map(|stretch| Trial::of(stretch, &linear.point).load_nm(joint))
        .collect();
    let stretched = model::Posture::new(0.0, 0.0);
    let base = &subject.robot.base;
    Typical {
        command_v: largest(&mut all(|s, j| &s.command_v[j])),
        friction_v: robot.friction[joint].alpha0_v,
        load_nm: rms(&load).max(1e-6),
        speed_rad_per_s: largest(&mut all(|s, j| &s.motion.qd_rad_per_s[j])),
        position_rad: angles.iter().sum::<f64>() / angles.len().max(1) as f64,
        inertia_kg_m2: stretched.mass_matrix(base, &subject.robot.geometry)[joint][joint],
    }
}
