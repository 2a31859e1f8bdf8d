//! Every effect on every joint, tried in a model.

use rayon::prelude::*;

use super::candidate::Candidate;
use super::harmonics;
use super::play::best_play;
use super::promise::Start;
use crate::fit::linearisation::Linearisation;
use crate::logs::subject::Subject;
use crate::rows::evidence::Evidence;
use crate::trial::equation::Trial;
use crate::trial::hypothesis::EffectInstance;
use rig::effects::{Definition, Search, Typical};
use signal::rms;

/// The best of every effect on every joint that is worth a search from these starts, the best first.
pub(super) fn candidates(
    starts: Vec<Vec<Start>>,
    linear: &Linearisation,
    evidence: &Evidence,
    subject: &Subject,
) -> Vec<Candidate> {
    let effort = &evidence.criteria.search;
    // A spring lets the torque that was measured correct its link, and promises to take a good part of
    // whatever is left.
    let least = |joint: u8| {
        let is_of = |start: &&Start| start.effect.joint == joint && !start.effect.is_spring();
        let of_joint = starts.iter().flatten().filter(is_of);
        let promised = of_joint.map(|start| start.gain).fold(0.0, f64::max);
        (effort.least_of_best_gain * promised).max(effort.least_promise)
    };
    let least: Vec<f64> = (0..=subject.plant.joints() as u8).map(least).collect();
    let mut found: Vec<Candidate> = starts
        .into_par_iter()
        .filter_map(|starts| searched(linear, evidence, starts, &least))
        .collect();
    found.sort_by(|a, b| a.train.total_cmp(&b.train));
    found
}

/// Effects and the joints that they can act on.
pub(crate) fn places(subject: &Subject) -> Vec<(&'static Definition, u8)> {
    let joints: Vec<u8> = subject.joints.iter().map(|&joint| joint as u8 + 1).collect();
    let of = |definition: &'static Definition| -> Vec<(&'static Definition, u8)> {
        match definition.whole_robot {
            true if is_an_offset(definition, subject) => Vec::new(),
            true => vec![(definition, 0)],
            false => joints.iter().map(|&joint| (definition, joint)).collect(),
        }
    };
    subject.catalogue.iter().flat_map(of).collect()
}

/// Whether an effect on the whole robot is what a joint of its own has: on an arm of one joint a force
/// at the tip or a lean is an offset, or a wave over the turn.
fn is_an_offset(definition: &Definition, subject: &Subject) -> bool {
    definition.touches.drive && subject.joints.len() == 1 && subject.plant.as_chain().is_some()
}

/// Those that a model with effects leaves: a second spring on a joint would only be the first
/// one searched for again.
pub(crate) fn places_open(
    subject: &Subject,
    effects: &[EffectInstance],
) -> Vec<(&'static Definition, u8)> {
    let mut places = places(subject);
    places.retain(|&(definition, joint)| {
        let same = |e: &EffectInstance| {
            e.definition.name == definition.name && e.joint == joint && !e.is_of_gear()
        };
        let alone = matches!(definition.search, Search::From(_));
        !(alone && effects.iter().any(same))
    });
    places
}

/// The first of an effect's starts.
pub(crate) fn first_start(
    linear: &Linearisation,
    evidence: &Evidence,
    subject: &Subject,
    definition: &'static Definition,
    joint: u8,
) -> Option<EffectInstance> {
    let values = start_values(linear, evidence, subject, definition, joint).into_iter().next()?;
    Some(EffectInstance { definition, joint, values })
}

/// Values of an effect's parameters from which a search may begin.
pub(super) fn start_values(
    linear: &Linearisation,
    evidence: &Evidence,
    subject: &Subject,
    definition: &'static Definition,
    joint: u8,
) -> Vec<Vec<f64>> {
    match definition.search {
        Search::From(starts) => starts(&typical(linear, evidence, subject, joint)),
        Search::Harmonics(carrier) => {
            let joint = usize::from(joint) - 1;
            harmonics::best(linear, evidence, joint, carrier)
                .iter()
                .map(harmonics::Harmonic::values)
                .collect()
        }
    }
}

/// The best that an effect's starts lead to; none where they promise less than is worth a search on
/// that joint.
fn searched(
    linear: &Linearisation,
    evidence: &Evidence,
    starts: Vec<Start>,
    least: &[f64],
) -> Option<Candidate> {
    let effort = &evidence.criteria.search;
    let is_promising = |start: &Start| start.gain > least[usize::from(start.effect.joint)];
    let starts: Vec<Start> = starts.into_iter().filter(is_promising).collect();
    if starts.first()?.effect.has_backlash() {
        return best_play(linear, evidence, starts);
    }
    let refined = |start: Start| {
        let first = Candidate::of(linear, evidence, start.effect).0;
        let steps = if first.effect.is_spring() { effort.spring_steps } else { effort.steps };
        first.refined(linear, evidence, steps)
    };
    starts.into_iter().map(refined).min_by(|a, b| a.train.total_cmp(&b.train))
}

/// What is typical of a joint (from 1, or 0 for the whole robot) in these logs.
pub(crate) fn typical(
    linear: &Linearisation,
    evidence: &Evidence,
    subject: &Subject,
    joint: u8,
) -> Typical {
    let is_of_all = joint == 0;
    let of_load = if is_of_all { evidence.joints.clone() } else { vec![usize::from(joint) - 1] };
    let loads = of_load.iter().map(|joint| load_nm(linear, evidence, *joint));
    let joint = usize::from(joint.max(1)) - 1;
    let plant = &linear.hypothesis.plant;
    let all = |signal: fn(&crate::logs::stretch::Stretch, usize) -> &[f64]| {
        evidence.stretches.iter().flat_map(move |stretch| signal(stretch, joint)).copied()
    };
    let largest = |values: &mut dyn Iterator<Item = f64>| values.map(f64::abs).fold(1e-9, f64::max);
    let angles: Vec<f64> = all(|s, j| &s.motion.q_rad[j]).collect();
    let command_v = largest(&mut all(|s, j| &s.command_v[j]));
    Typical {
        command_v,
        motor_nm: command_v * plant.torque_constant_nm_per_v[joint],
        friction_v: plant.friction[joint].alpha0_v,
        load_nm: loads.fold(1e-6, f64::max),
        speed_rad_per_s: largest(&mut all(|s, j| &s.motion.qd_rad_per_s[j])),
        position_rad: angles.iter().sum::<f64>() / angles.len().max(1) as f64,
        inertia_kg_m2: subject.inertia_kg_m2(joint),
        tip_height_m: if is_of_all { tip_height_m(evidence, plant) } else { [0.0; 2] },
    }
}

/// Loads and places change slowly: every so many samples tell them.
const SAMPLES: usize = 20;

/// Load of a joint (from 0) along the logs, rms [Nm].
fn load_nm(linear: &Linearisation, evidence: &Evidence, joint: usize) -> f64 {
    let of_stretch = |stretch| {
        let trial = Trial::of(stretch, &linear.hypothesis, &evidence.criteria.fit);
        trial.load_at_every_nm(joint, SAMPLES)
    };
    rms(&evidence.stretches.iter().flat_map(of_stretch).collect::<Vec<f64>>())
}

/// Lowest and highest place of the tip along the logs [m].
fn tip_height_m(evidence: &Evidence, plant: &rig::Plant) -> [f64; 2] {
    let mut range = [f64::INFINITY, f64::NEG_INFINITY];
    for stretch in evidence.stretches.iter() {
        for k in (0..stretch.len()).step_by(SAMPLES) {
            let q: Vec<f64> = stretch.motion.q_rad.iter().map(|q| q[k]).collect();
            let height_m = plant.body.tip_height_m(&q);
            range = [range[0].min(height_m), range[1].max(height_m)];
        }
    }
    range
}
