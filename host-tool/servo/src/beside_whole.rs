//! An effect of the whole arm beside the friction of its joints.
//!
//! Friction that grows with the load, or less than with the velocity, looks like a load where a joint is alone:
//! on simulated pendulums whose friction has both and a peak, gravity came out 8 % too large, and a load of that
//! size was named where there was none; and it hides a load that pulls the other way. So an effect of the whole
//! arm that is found, and the payload of a joint that is alone, found or not, is sought again with friction open
//! on every joint of whose logs that takes a good part, and stands if it takes its part of what is left beside it.

use files::ArmFile;

use crate::base::{Base, Frame, refit};
use crate::confirm::{squares, units};
use crate::fit::fit;
use crate::joint::ServoJoint;
use crate::joint_effects::JointEffects;
use crate::judged::Judged;
use crate::open_friction::with_open_friction;
use crate::prepared::Prepared;
use crate::settings::Settings;
use crate::whole_cause::{WholeCause, find_from};
use crate::whole_effect::Whole;
use crate::whole_fit::{WholeFit, rigid};

/// The arm with what acts on all of it, and what was found joint by joint beside that.
pub struct Found {
    /// The logs with the effect of the whole arm.
    pub prepared: Prepared,
    /// Effects of joints beside it.
    pub joints: JointEffects,
    /// Effects of the whole arm that were tried, best first.
    pub whole: Vec<WholeCause>,
    /// The joints that they were tried over.
    pub bases: Vec<Base>,
}

/// What is found once an effect of the whole arm is named, or beside the payload of a joint that is alone. Where
/// none is named beside the joints' friction, all is as it was but the effects that were tried.
pub fn beside_whole(
    found: Found,
    arm: &ArmFile,
    settings: &Settings,
    progress: &dyn Fn(&str),
) -> Found {
    let named = |whole: &[WholeCause]| whole.first().filter(|cause| cause.is_named).cloned();
    let Some(cause) = named(&found.whole).or_else(|| payload_of_one_joint(&found)) else {
        return found;
    };
    let with = loaded(&found.prepared, &cause, settings);
    let (prepared, whole) =
        match with_open_friction(&with, &found.bases, &cause.fit.servos, settings) {
            None => (with, found.whole),
            Some(bases) => {
                progress("trying it again beside the joints' friction");
                let whole = again(&found.prepared, &cause, bases, settings);
                let Some(cause) = named(&whole) else { return Found { whole, ..found } };
                (loaded(&found.prepared, &cause, settings), whole)
            }
        };
    let least = least_beside(&found.prepared, &prepared, settings);
    let beside = settings.beside_whole();
    let joints = JointEffects::taking(&least, &prepared, arm, &beside, progress);
    Found { prepared, joints, whole, bases: found.bases }
}

/// The payload that fits best where a joint is alone: there friction may hide a load as well as look like one.
fn payload_of_one_joint(found: &Found) -> Option<WholeCause> {
    let mut payloads = found.whole.iter().filter(|cause| cause.fit.effect == Whole::Payload);
    payloads.next().filter(|_| found.bases.len() == 1).cloned()
}

/// Effects of the whole arm with these joints, the one that was found from where it was, too.
fn again(
    prepared: &Prepared,
    cause: &WholeCause,
    bases: Vec<Base>,
    settings: &Settings,
) -> Vec<WholeCause> {
    let known = WholeFit { servos: rigid(&bases), ..cause.fit.clone() };
    let bases = refitted(prepared, bases, settings);
    find_from(prepared, &bases, Some(&known), settings)
}

/// The arm with an effect in its logs, the bare joints refitted with it.
fn loaded(prepared: &Prepared, cause: &WholeCause, settings: &Settings) -> Prepared {
    let mut loaded = prepared.clone();
    let (effect, values, links) = (cause.fit.effect, &cause.fit.values, prepared.links);
    let changed = effect.links(&links, values);
    loaded.follow(&changed, effect.force(values), &cause.fit.servos, settings);
    let applied = |log: &Judged| effect.applied(&links, log, values);
    loaded.logs = loaded.logs.iter().map(applied).collect();
    let train = loaded.train();
    let frame = Frame { logs: &train, period_s: loaded.period_s, settings };
    // Refitted from where the fit with the effect ended, without what else that held.
    let start = |(base, servo): (&Base, &ServoJoint)| base.with_values_of(servo);
    let starts: Vec<ServoJoint> = prepared.bases.iter().zip(&cause.fit.servos).map(start).collect();
    let bases = refit(&frame, &loaded.given, &starts, false);
    Prepared { bases, ..loaded }
}

/// Squares of the confirming logs that an effect of each joint must take beside one of the whole arm [rad^2]: that is
/// a little wrong, and what it leaves is none of theirs.
fn least_beside(before: &Prepared, loaded: &Prepared, settings: &Settings) -> Vec<f64> {
    let left = |prepared: &Prepared, joint: usize| {
        let servo = &prepared.bases[joint].fitted.servo;
        squares(&units(servo, joint, &prepared.held_out(), settings.search_step_s))
    };
    let part = settings.least_part_of_whole.powi(2);
    let joints = 0..before.bases.len();
    joints.map(|joint| part * (left(before, joint) - left(loaded, joint)).max(0.0)).collect()
}

/// Joints with effects fitted to the logs of an arm, from where they were; blocks weigh as they did there.
fn refitted(prepared: &Prepared, bases: Vec<Base>, settings: &Settings) -> Vec<Base> {
    let train = prepared.train();
    let frame = Frame { logs: &train, period_s: prepared.period_s, settings };
    let of = |(joint, base): (usize, Base)| {
        let scale = prepared.bases[joint].scale;
        let problem = frame.problem(joint, &base.unknowns, scale);
        Base { fitted: fit(&problem, &base.fitted.servo), scale, ..base }
    };
    bases.into_iter().enumerate().map(of).collect()
}
