//! The procedure: from a campaign to what its report says.

use files::{ArmFile, Role};
use recordings::ArmCampaign;

use crate::arm_replay::arm_replay;
use crate::base::Frame;
use crate::beside_whole::{Found, beside_whole};
use crate::error::ServoError;
use crate::joint::ServoJoint;
use crate::joint_effects::{JointEffects, PooledCauses};
use crate::joint_model::Model;
use crate::judged::Judged;
use crate::prepared::Prepared;
use crate::selection::Selected;
use crate::settings::Settings;
use crate::spread::spread;
use crate::turned;
use crate::verdict::JointCause;
use crate::whole_cause::{WholeCause, find};
use crate::whole_fit::left;

/// What a diagnosis found.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The arm as given.
    pub arm: ArmFile,
    /// Logs, contacts, refitted joints.
    pub prepared: Prepared,
    /// Effects of the whole arm that were tried, best first.
    pub whole: Vec<WholeCause>,
    /// What was selected, joint by joint.
    pub selected: Vec<Selected>,
    /// Effects on joints, named or not.
    pub causes: Vec<JointCause>,
    /// Load friction of servos of one type, where it was found.
    pub pooled: Vec<PooledCauses>,
    /// The joints with what is named.
    pub models: Vec<Model>,
    /// Positions on the confirming logs: as given, refitted, with effects, by log and joint.
    pub motions: Vec<Motions>,
    /// The choices.
    pub settings: Settings,
}

/// Simulated positions of a log, by joint and row.
#[derive(Clone, Debug)]
pub struct Motions {
    /// Which of the prepared logs.
    pub log: usize,
    /// As given, refitted, with effects.
    pub stages: [Vec<Vec<f64>>; 3],
}

impl Outcome {
    /// Diagnoses a campaign; `progress` hears what is under way.
    ///
    /// # Errors
    /// Drives, links or logs that cannot be used.
    pub fn of(
        campaign: &ArmCampaign,
        settings: &Settings,
        progress: &dyn Fn(&str),
    ) -> Result<Self, ServoError> {
        progress("refitting the joints, looking for contact");
        let mut prepared = Prepared::of(campaign, settings)?;
        let refitted = prepared.bases.clone();
        let mut joints = JointEffects::of(&prepared, &campaign.arm, settings, progress);
        progress("trying a payload, a force, a base that leans");
        let beside = |found: Found| beside_whole(found, &campaign.arm, settings, progress);
        let is_named = |found: &Found| found.whole.first().is_some_and(|cause| cause.is_named);
        let first = instead(&prepared, &joints, settings).map(|whole| {
            let bases = prepared.bases.clone();
            beside(Found { prepared: prepared.clone(), joints: joints.clone(), whole, bases })
        });
        let found = first.filter(is_named).unwrap_or_else(|| {
            let unturned = prepared.clone();
            if turned::take_up(&mut prepared, &joints, settings) {
                let found = JointEffects::of(&prepared, &campaign.arm, settings, progress);
                match turned::is_named(&found) {
                    true => joints = found,
                    false => prepared = unturned,
                }
            }
            let bases = joints.as_bases(&prepared);
            let whole = find(&prepared, &bases, settings);
            beside(Found { prepared, joints, whole, bases })
        });
        let Found { prepared, joints, whole, .. } = found;
        let JointEffects { selected, causes, pooled, models } = joints;
        let servos = [
            prepared.given.clone(),
            refitted.iter().map(|base| base.fitted.servo).collect(),
            models.iter().map(|model| model.fitted.servo).collect(),
        ];
        progress("simulating the arm");
        let motions = motions(&prepared, whole.first(), &servos, settings);
        let (arm, settings) = (campaign.arm.clone(), settings.clone());
        Ok(Self { arm, prepared, whole, selected, causes, pooled, models, motions, settings })
    }
}

/// Effects of the whole arm over the bare joints, where the first is named and leaves less than all that was
/// found joint by joint does: what one thing explains on many joints is not many things.
fn instead(
    prepared: &Prepared,
    joints: &JointEffects,
    settings: &Settings,
) -> Option<Vec<WholeCause>> {
    joints.causes.iter().find(|cause| cause.is_named)?;
    let whole = find(prepared, &prepared.bases, settings);
    let best = whole.first().filter(|cause| cause.is_named)?;
    let servos: Vec<ServoJoint> = joints.models.iter().map(|model| model.fitted.servo).collect();
    let logs = spread(&prepared.train(), settings.whole_arm_s);
    let frame = Frame { logs: &logs, period_s: prepared.period_s, settings };
    let of_joints: f64 = left(&frame, &prepared.bases, &servos, &logs).iter().sum();
    (best.fit.left.iter().sum::<f64>() < of_joints).then_some(whole)
}

fn motions(
    prepared: &Prepared,
    whole: Option<&WholeCause>,
    servos: &[Vec<ServoJoint>; 3],
    settings: &Settings,
) -> Vec<Motions> {
    use rayon::prelude::*;
    let loaded = match whole.filter(|cause| cause.is_named) {
        Some(cause) => cause.fit.effect.links(&prepared.links, &cause.fit.values),
        None => prepared.links,
    };
    let links = [prepared.links, prepared.links, loaded];
    let pull = whole.filter(|cause| cause.is_named);
    let pull = pull.map_or([0.0; 3], |cause| cause.fit.effect.force(&cause.fit.values));
    let forces = [[0.0; 3], [0.0; 3], pull];
    let of = |(number, log): (usize, &Judged)| {
        let record = &log.record;
        let stage = |k: usize| -> Vec<Vec<f64>> {
            let found = arm_replay(&links[k], forces[k], &servos[k], record, settings.step_s);
            let pairs = found.iter().zip(&servos[k]);
            pairs.map(|(joint, s)| joint.read(&record.time_s, s.read_after_s, s.gap)).collect()
        };
        Motions { log: number, stages: [stage(0), stage(1), stage(2)] }
    };
    let logs = prepared.logs.par_iter().enumerate();
    logs.filter(|(_, log)| log.record.role == Role::Holdout).map(of).collect()
}
