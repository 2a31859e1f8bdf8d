//! Identification alone: the joints refitted to the logs of any motion.

use files::ArmFile;
use recordings::ArmCampaign;
use serde::Serialize;

use crate::confirm::{rms, units};
use crate::error::ServoError;
use crate::joint::ServoJoint;
use crate::model_file::refitted;
use crate::prepared::Prepared;
use crate::report_remarks::of_prepared;
use crate::settings::Settings;

/// An identified arm.
#[derive(Clone, Debug)]
pub struct Identified {
    /// Its model.
    pub model: ArmFile,
    /// How good it is.
    pub summary: Summary,
}

/// `identification.json`.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    /// Joint by joint.
    pub joints: Vec<JointSummary>,
    /// Contacts and clipped goals.
    pub remarks: Vec<String>,
}

/// A joint, on logs held out or on the last part of each.
#[derive(Clone, Debug, Serialize)]
#[allow(missing_docs)] // the names say it
pub struct JointSummary {
    pub joint: usize,
    pub as_given_rad: f64,
    pub refitted_rad: f64,
    pub armature: f64,
    pub coulomb_v: f64,
    pub viscous_v_s: f64,
    pub gravity_scale: f64,
    pub read_after_goal_s: f64,
}

impl Identified {
    /// Identifies the arm of a campaign.
    ///
    /// # Errors
    /// Drives, links or logs that cannot be used.
    pub fn of(campaign: &ArmCampaign, settings: &Settings) -> Result<Self, ServoError> {
        let prepared = Prepared::of(campaign, settings)?;
        let logs = prepared.held_out();
        let servos: Vec<ServoJoint> = prepared.bases.iter().map(|base| base.fitted.servo).collect();
        let left = |servo: &ServoJoint, k: usize| rms(&units(servo, k, &logs, settings.step_s));
        let joints = servos.iter().enumerate().map(|(k, servo)| JointSummary {
            joint: k + 1,
            as_given_rad: left(&prepared.given[k], k),
            refitted_rad: left(servo, k),
            armature: servo.rotor,
            coulomb_v: servo.coulomb,
            viscous_v_s: servo.viscous,
            gravity_scale: servo.gravity,
            read_after_goal_s: servo.read_after_s,
        });
        let summary = Summary { joints: joints.collect(), remarks: of_prepared(&prepared) };
        Ok(Self { model: refitted(&campaign.arm, &servos), summary })
    }
}
