//! An effect of the whole arm beside the friction of its joints.
//!
//! Friction that grows with the load, or less than with the velocity, looks like a load where a joint is alone:
//! on simulated pendulums whose friction has both and a peak, gravity came out 8 % too large, and a load of that
//! size was named where there was none. So an effect of the whole arm that is found is sought again with both
//! open on every joint, named or not, and stands if it takes its part of what is left beside them.

use files::{ArmFile, Role};

use crate::base::{Base, Frame, refit};
use crate::candidates::like_a_load;
use crate::fit::fit;
use crate::joint::ServoJoint;
use crate::joint_effects::JointEffects;
use crate::joint_model::Model;
use crate::judged::Judged;
use crate::prepared::Prepared;
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
    let Some(cause) = found.whole.first().filter(|cause| cause.is_named) else { return found };
    progress("trying it again beside the joints' friction");
    let whole = again(&found.prepared, cause, settings);
    let Some(cause) = whole.first().filter(|cause| cause.is_named) else {
        return Found { whole, ..found };
    };
    let mut prepared = found.prepared;
    take_up(&mut prepared, cause, settings);
    let joints = JointEffects::of(&prepared, arm, &settings.beside_whole(), progress);
    Found { prepared, joints, whole }
}

/// Effects of the whole arm with the joints' friction open, the one that was found from where it was, too.
fn again(prepared: &Prepared, cause: &WholeCause, settings: &Settings) -> Vec<WholeCause> {
    let mut loaded = prepared.clone();
    take_up(&mut loaded, cause, settings);
    let bases = with_friction(&loaded, settings);
    let rigid = |base: &Base| ServoJoint { gravity: 1.0, ..base.fitted.servo };
    let known = WholeFit { servos: bases.iter().map(rigid).collect(), ..cause.fit.clone() };
    let bases = refitted(prepared, bases, settings);
    find_from(prepared, &bases, Some(&known), settings)
}

/// The joints with what of their friction may look like a load open.
fn with_friction(prepared: &Prepared, settings: &Settings) -> Vec<Base> {
    let train = prepared.train();
    let frame = Frame { logs: &train, period_s: prepared.period_s, settings };
    let of = |(joint, base): (usize, &Base)| {
        let more =
            |model: Model, effect| model.with(&frame, joint, base.scale, effect).unwrap_or(model);
        let bare = Model::of_base(&frame, joint, base);
        let model = like_a_load(base).iter().fold(bare, more);
        Base { unknowns: model.unknowns, fitted: model.fitted, ..base.clone() }
    };
    prepared.bases.iter().enumerate().map(of).collect()
}

/// Puts an effect of the whole arm into the logs, and refits the bare joints with it.
fn take_up(prepared: &mut Prepared, cause: &WholeCause, settings: &Settings) {
    let (effect, values) = (cause.fit.effect, &cause.fit.values);
    let links = prepared.links;
    let applied = |log: &Judged| effect.applied(&links, log, values);
    prepared.follow(
        &effect.links(&links, values),
        effect.force(values),
        &cause.fit.servos,
        settings,
    );
    prepared.logs = prepared.logs.iter().map(applied).collect();
    let train: Vec<&Judged> =
        prepared.logs.iter().filter(|log| log.record.role == Role::Train).collect();
    let frame = Frame { logs: &train, period_s: prepared.period_s, settings };
    let starts: Vec<ServoJoint> = prepared.bases.iter().map(|base| base.fitted.servo).collect();
    let bases: Vec<Base> = refit(&frame, &prepared.given, &starts, false);
    prepared.bases = bases;
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
