//! Effects on all joints: selected, confirmed, shared by servos of one type.

use files::ArmFile;

use crate::base::{Base, Frame};
use crate::candidates::MOST_LOST;
use crate::fit::{Field, Unknown};
use crate::joint_model::Model;
use crate::pooled::{PooledLoad, groups, load_friction};
use crate::prepared::Prepared;
use crate::ranking::suffices;
use crate::selection::{Selected, select};
use crate::settings::Settings;
use crate::verdict::{Confirming, JointCause, named_model, of_joint, of_pool};

/// Load friction in common, and what it takes joint by joint, most first.
pub type PooledCauses = (PooledLoad, Vec<JointCause>);

/// What was found joint by joint.
#[derive(Clone, Debug)]
pub struct JointEffects {
    /// What was selected.
    pub selected: Vec<Selected>,
    /// Effects that were confirmed or not.
    pub causes: Vec<JointCause>,
    /// Load friction of servos of one type.
    pub pooled: Vec<PooledCauses>,
    /// The joints with what is named.
    pub models: Vec<Model>,
}

/// A row's square by the encoder's step alone, joint by joint [rad^2].
pub fn noise(arm: &ArmFile) -> Vec<f64> {
    let of = |joint: &files::ArmJoint| joint.count_step().unwrap_or(0.0).powi(2) / 12.0;
    arm.joints.iter().map(of).collect()
}

impl JointEffects {
    /// Tries all effects on all joints.
    pub fn of(
        prepared: &Prepared,
        arm: &ArmFile,
        settings: &Settings,
        progress: &dyn Fn(&str),
    ) -> Self {
        Self::taking(&vec![0.0; prepared.bases.len()], prepared, arm, settings, progress)
    }

    /// The same; what takes fewer squares of its joint's confirming logs than these is not named [rad^2].
    pub fn taking(
        least: &[f64],
        prepared: &Prepared,
        arm: &ArmFile,
        settings: &Settings,
        progress: &dyn Fn(&str),
    ) -> Self {
        let (train, held_out) = (prepared.train(), prepared.held_out());
        let frame = Frame { logs: &train, period_s: prepared.period_s, settings };
        let noise = noise(arm);
        let confirming = Confirming { logs: &held_out, noise: &noise, least };
        let (mut selected, mut causes, mut models) = (Vec::new(), Vec::new(), Vec::new());
        for (joint, base) in prepared.bases.iter().enumerate() {
            progress(&format!("trying effects on joint {}", joint + 1));
            let found = select(&frame, joint, base);
            let of = of_joint(&frame, &confirming, joint, base, &found);
            models.push(named_model(&frame, joint, base, &found, &of));
            causes.extend(of);
            selected.push(found);
        }
        // What acts on one servo alone is none of its type's.
        let own = |joint: &usize| causes.iter().any(|c| c.is_named && c.joint == *joint);
        let alone = |group: Vec<usize>| group.into_iter().filter(|joint| !own(joint)).collect();
        let pooled = groups(&prepared.given)
            .into_iter()
            .map(alone)
            .filter(|group: &Vec<usize>| group.len() >= 3)
            .map(|group| load_friction(&frame, &prepared.bases, &group))
            .filter(|pooled| suffices(&pooled.gain, settings))
            .map(|pooled| (of_pool(&frame, &confirming, &pooled), pooled))
            .map(|(causes, pooled)| (pooled, causes))
            .collect();
        Self { selected, causes, pooled, models }
    }

    /// The joints with what is named, as something to go on from.
    pub fn as_bases(&self, prepared: &Prepared) -> Vec<Base> {
        let with = |(base, model): (&Base, &Model)| Base {
            unknowns: model.unknowns.clone(),
            fitted: model.fitted.clone(),
            ..base.clone()
        };
        let mut bases: Vec<Base> = prepared.bases.iter().zip(&self.models).map(with).collect();
        for (pooled, causes) in &self.pooled {
            if !causes.iter().any(|cause| cause.is_named) {
                continue;
            }
            for (joint, servo) in pooled.with.joints.iter().zip(&pooled.with.servos) {
                let most = MOST_LOST / servo.torque_constant;
                let near = (servo.motor_load_friction, 0.1 * most);
                let field = Field::MotorLoadFriction;
                bases[*joint].fitted.servo = *servo;
                bases[*joint].unknowns.push(Unknown::between(
                    field,
                    [0.0, most],
                    near,
                    0.05 * most,
                ));
            }
        }
        bases
    }
}
