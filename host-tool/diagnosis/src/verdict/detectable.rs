//! The smallest size of each effect that these logs would have shown, and what they cannot
//! show.

use rayon::prelude::*;

use crate::fit::linearisation::Linearisation;
use crate::fit::row_changes::Joints;
use crate::logs::subject::Subject;
use crate::quantity::{quantity, split_unit};
use crate::result::{Detectable, Untestable};
use crate::rows::evidence::{Evidence, RowChange};
use crate::search::candidates::{first_start, places, typical};
use crate::trial::hypothesis::EffectInstance;
use rig::effects::{Confused, Definition, Kind};

/// What the logs would have shown of an effect on a joint.
struct Sight {
    definition: &'static Definition,
    joint: u8,
    effect: EffectInstance,
    /// Squares of the rows that a start of the effect changes, everything open refitted.
    squares: f64,
    change: RowChange,
}

/// Smallest sizes, and what cannot be tested, for the model as it stands.
pub fn detectable(
    linear: &Linearisation,
    evidence: &Evidence,
    subject: &Subject,
) -> (Vec<Detectable>, Vec<Untestable>) {
    let sights: Vec<Sight> = places_without_doubt(subject)
        .par_iter()
        .filter_map(|&(definition, joint)| sight(linear, evidence, subject, definition, joint))
        .collect();
    let wanted = wanted_squares(evidence);
    let mut seen = Vec::new();
    let mut unseen = Vec::new();
    for sight in &sights {
        let outer = subject.outer_joint(sight.joint);
        let size = smallest(sight, wanted);
        let useless =
            (sight.definition.size.useless)(&typical(linear, evidence, subject, sight.joint));
        let useful = size.is_finite() && (size < useless) == sight.definition.size.grows;
        if useful {
            seen.push(Detectable {
                effect: sight.definition.name.into(),
                joint: outer,
                parameter: sight.definition.parameters[0].name.into(),
                size,
            });
        } else {
            unseen.push(Untestable {
                effect: sight.definition.name.into(),
                joint: outer,
                why: why_unseen(sight, size, useless, subject),
            });
        }
    }
    unseen.extend(alike(linear, subject, &sights));
    unseen.extend(in_doubt(subject));
    (seen, unseen)
}

/// Effects and joints, but for torque constants that are in doubt: held in the model, they would seem to show.
fn places_without_doubt(subject: &Subject) -> Vec<(&'static Definition, u8)> {
    let mut places = places(subject);
    places.retain(|(definition, joint)| {
        !subject.in_doubt().iter().any(|(of, at, _)| (of.name, at) == (definition.name, joint))
    });
    places
}

/// Torque constants that are in doubt, and what would tell them.
fn in_doubt(subject: &Subject) -> impl Iterator<Item = Untestable> {
    subject.in_doubt().iter().map(|(definition, joint, _)| Untestable {
        effect: definition.name.into(),
        joint: subject.outer_joint(*joint),
        why: format!(
            "told against those of other joints only; {} would",
            subject.experiment(definition)
        ),
    })
}

/// Why no log shows an effect of this size, in the units of its joint, and what would show it. Far from where it is of
/// any use, a size is none.
fn why_unseen(sight: &Sight, size: f64, useless: f64, subject: &Subject) -> String {
    const FAR: f64 = 100.0;
    let definition = &sight.definition;
    let (name, unit) = split_unit(definition.parameters[0].name);
    let side = if definition.size.grows { "below" } else { "above" };
    let said = match unit {
        _ if !size.is_finite() || size > FAR * useless || useless > FAR * size => "at all".into(),
        "" => format!("{side} {:.0} % ({})", 100.0 * size, name.replace('_', " ")),
        unit => format!("{side} {} ({})", quantity(size, unit), name.replace('_', " ")),
    };
    let joint = usize::from(sight.joint).checked_sub(1);
    let units = joint.and_then(|joint| subject.units.get(joint)).copied().unwrap_or_default();
    format!(
        "no log would show it {}; {} would",
        units.in_words(&said),
        subject.experiment(definition)
    )
}

/// Squares that lift what is left of a log above what the method itself may leave.
fn wanted_squares(evidence: &Evidence) -> f64 {
    let joint = evidence.joints[0];
    let mut counts: Vec<usize> =
        (0..evidence.train_stretches()).map(|s| evidence.row_count(joint, s)).collect();
    counts.sort_unstable();
    let middle = counts.get(counts.len() / 2).copied().unwrap_or(1);
    let own_ratio = evidence.criteria.fit.own_ratio;
    (own_ratio * own_ratio - 1.0) * middle as f64
}

fn sight(
    linear: &Linearisation,
    evidence: &Evidence,
    subject: &Subject,
    definition: &'static Definition,
    joint: u8,
) -> Option<Sight> {
    let effect = first_start(linear, evidence, subject, definition, joint)?;
    let change = linear.change_by(evidence, &effect, Joints::Own);
    let (_, curvature) = linear.along(&RowChange::default(), std::slice::from_ref(&change));
    Some(Sight { definition, joint, effect, squares: curvature[(0, 0)], change })
}

/// The first parameter at which the effect would change so many squares.
fn smallest(sight: &Sight, wanted: f64) -> f64 {
    let factor = (wanted / sight.squares.max(1e-300)).sqrt();
    let value = sight.effect.values[0].abs();
    match sight.definition.parameters[0].kind {
        // A limit shows where commands reach it at all.
        Kind::Limit => value,
        _ if sight.definition.size.grows => value * factor,
        _ => value / factor,
    }
}

/// Pairs of effects that the logs do not tell apart, of those that are known to be alike.
fn alike(linear: &Linearisation, subject: &Subject, sights: &[Sight]) -> Vec<Untestable> {
    let pairs = subject.catalogue.iter().flat_map(|definition| {
        let compared = definition.confused_with.iter().filter(|confusion| confusion.compared);
        compared.map(move |confusion| (definition.name, confusion.with))
    });
    let mut found = Vec::new();
    for (a, b) in pairs {
        for first in sights.iter().filter(|sight| sight.definition.name == a) {
            let on =
                |s: &&Sight| Confused::Effect(s.definition.name) == b && s.joint == first.joint;
            let Some(second) = sights.iter().find(on) else { continue };
            let both = [first.change.clone(), second.change.clone()];
            let (_, c) = linear.along(&RowChange::default(), &both);
            let same = c[(0, 1)] * c[(0, 1)] / (c[(0, 0)] * c[(1, 1)]).max(1e-300);
            if same > subject.criteria.verdict.alike_correlation {
                found.push(Untestable {
                    effect: second.definition.name.into(),
                    joint: subject.outer_joint(first.joint),
                    why: format!(
                        "these logs do not tell it from {a}; {} would",
                        subject.experiment(second.definition)
                    ),
                });
            }
        }
    }
    found
}
