//! An effect of the whole arm beside the friction of its joints.
//!
//! Friction that grows with the load, or less than with the velocity, looks like a load where a joint is alone:
//! on simulated pendulums whose friction has both and a peak, gravity came out 8 % too large, and a load of that
//! size was named where there was none. So an effect of the whole arm that is found is sought again with what
//! looks like it open on every joint of whose logs that takes a good part, named or not, and stands if it takes
//! its part of what is left beside it.

use files::ArmFile;

use crate::base::{Base, Frame, refit};
use crate::candidates::like_a_load;
use crate::cross::Gain;
use crate::fit::fit;
use crate::joint::ServoJoint;
use crate::joint_effects::JointEffects;
use crate::joint_model::Model;
use crate::judged::Judged;
use crate::prepared::Prepared;
use crate::ranking::suffices;
use crate::settings::Settings;
use crate::whole_cause::{WholeCause, find_from};
use crate::whole_fit::WholeFit;

/// The arm with what acts on all of it, and what was found joint by joint beside that.
pub struct Found {
    /// The logs with the effect of the whole arm.
    pub prepared: Prepared,
    /// Effects of joints beside it.
    pub joints: JointEffects,
    /// Effects of the whole arm that were tried, best first.
    pub whole: Vec<WholeCause>,
}

/// What is found once an effect of the whole arm is named; all as it was where none is, or where none is any
/// more beside the joints' friction.
pub fn beside_whole(
    found: Found,
    arm: &ArmFile,
    settings: &Settings,
    progress: &dyn Fn(&str),
) -> Found {
    let named = |whole: &[WholeCause]| whole.first().filter(|cause| cause.is_named).cloned();
    let Some(cause) = named(&found.whole) else { return found };
    let with = loaded(&found.prepared, &cause, settings);
    let (prepared, whole) = match with_friction(&with, settings) {
        None => (with, found.whole),
        Some(bases) => {
            progress("trying it again beside the joints' friction");
            let whole = again(&found.prepared, &cause, bases, settings);
            let Some(cause) = named(&whole) else { return Found { whole, ..found } };
            (loaded(&found.prepared, &cause, settings), whole)
        }
    };
    let joints = JointEffects::of(&prepared, arm, &settings.beside_whole(), progress);
    Found { prepared, joints, whole }
}

/// Effects of the whole arm with these joints, the one that was found from where it was, too.
fn again(
    prepared: &Prepared,
    cause: &WholeCause,
    bases: Vec<Base>,
    settings: &Settings,
) -> Vec<WholeCause> {
    let rigid = |base: &Base| ServoJoint { gravity: 1.0, ..base.fitted.servo };
    let known = WholeFit { servos: bases.iter().map(rigid).collect(), ..cause.fit.clone() };
    let bases = refitted(prepared, bases, settings);
    find_from(prepared, &bases, Some(&known), settings)
}

/// The joints with what of their friction may look like a load open where that takes a good part; none where it
/// does on no joint.
fn with_friction(prepared: &Prepared, settings: &Settings) -> Option<Vec<Base>> {
    let train = prepared.train();
    let frame = Frame { logs: &train, period_s: prepared.period_s, settings };
    let of = |(joint, base): (usize, &Base)| {
        let more =
            |model: Model, effect| model.with(&frame, joint, base.scale, effect).unwrap_or(model);
        let bare = Model::of_base(&frame, joint, base);
        let model = like_a_load(base).iter().fold(bare.clone(), more);
        let takes = suffices(&Gain::of(&model.left, &bare.left), &bare.settings(settings));
        takes.then(|| Base { unknowns: model.unknowns, fitted: model.fitted, ..base.clone() })
    };
    let found: Vec<Option<Base>> = prepared.bases.iter().enumerate().map(of).collect();
    let any = found.iter().any(Option::is_some);
    let both = found.into_iter().zip(&prepared.bases);
    any.then(|| both.map(|(with, bare)| with.unwrap_or_else(|| bare.clone())).collect())
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

/// Joints with effects fitted to the logs of an arm, from where they were.
fn refitted(prepared: &Prepared, bases: Vec<Base>, settings: &Settings) -> Vec<Base> {
    let train = prepared.train();
    let frame = Frame { logs: &train, period_s: prepared.period_s, settings };
    let of = |(joint, base): (usize, Base)| {
        let problem = frame.problem(joint, &base.unknowns, base.scale);
        Base { fitted: fit(&problem, &base.fitted.servo), ..base }
    };
    bases.into_iter().enumerate().map(of).collect()
}
