//! A case: an arm, its model, and what the model does not have.

use files::arm_file::DriveKind;
use files::{ArmFile, EffectTable};
use recordings::{ArmCampaign, ArmRecording};
use rig::Plant;
use rig::effects::Catalogue;
use serde::Serialize;
use servo::simulated::{gap_recording, simulated};
use simulation::arm_recording::{ArmPlan, gap_plans};
use simulation::record_arm;

use super::kind::ArmKind;
use crate::case::Kind;
use crate::cause::TrueCause;
use crate::error::TrialError;
use diagnosis::Value;

/// Samples per second of arms whose drives take no goals.
const RATE_HZ: f64 = 500.0;

/// A case of a trial.
#[derive(Clone, Debug, Serialize)]
pub struct ArmCase {
    /// 1, 2, ...
    pub number: u32,
    /// Whether something is hidden.
    pub kind: Kind,
    /// The kind of arm.
    pub arm: ArmKind,
    /// The model that the diagnosis gets.
    #[serde(skip)]
    pub nominal: ArmFile,
    /// The arm without what is hidden.
    #[serde(skip)]
    pub truth: ArmFile,
    /// What is hidden.
    pub cause: Option<TrueCause>,
    /// The probability that somebody who knows the arm names it.
    pub oracle: Option<f64>,
    /// Of motions and noise.
    pub seed: u64,
}

impl ArmCase {
    /// The true arm with what is hidden, as a model file would have it.
    pub fn whole_truth(&self) -> ArmFile {
        let mut whole = self.truth.clone();
        whole.effects.extend(self.cause.as_ref().map(table));
        whole
    }

    /// Its logs beside the model given.
    ///
    /// # Errors
    /// An effect that the arm cannot have.
    pub fn record(&self) -> Result<ArmCampaign, TrialError> {
        let campaign = if self.arm.is_of_servos() { self.of_servos() } else { self.of_loop() }?;
        Ok(ArmCampaign { arm: self.nominal.clone(), ..campaign })
    }

    fn of_servos(&self) -> Result<ArmCampaign, TrialError> {
        let hidden: Vec<EffectTable> = self.cause.iter().map(table).collect();
        Ok(simulated(&self.truth, &hidden, &gap_recording(&self.truth), self.seed)?)
    }

    /// Under a PD loop.
    fn of_loop(&self) -> Result<ArmCampaign, TrialError> {
        let plant = plant(&self.truth)?;
        let catalogue = Catalogue::of_arm(self.truth.joints.len());
        let recording = |plan: ArmPlan| {
            let hidden = self.cause.iter().map(|cause| catalogue.effect_of(&table(cause)));
            let effects = hidden.collect::<Result<_, _>>()?;
            let log = record_arm(&self.truth, &plant, effects, &plan.motion);
            Ok(ArmRecording { file: format!("{}.csv", plan.name), role: plan.role, log })
        };
        let recordings = gap_plans(RATE_HZ, self.seed).into_iter().map(recording);
        let recordings = recordings.collect::<Result<_, TrialError>>()?;
        Ok(ArmCampaign { arm: self.truth.clone(), recordings })
    }
}

/// An arm as a plant; a servo's as one that takes voltages.
///
/// # Errors
/// A file that describes none.
pub fn plant(arm: &ArmFile) -> Result<Plant, TrialError> {
    let mut arm = arm.clone();
    for drive in arm.joints.iter_mut().filter_map(|joint| joint.drive.as_mut()) {
        if drive.kind == DriveKind::PositionServo {
            drive.kind = DriveKind::Voltage;
        }
    }
    Ok(Plant::of_arm(&arm)?)
}

/// A cause as a table of a model file.
fn table(cause: &TrueCause) -> EffectTable {
    let float = |value: &f64| toml::Value::Float(*value);
    let parameter = |(name, value): (&String, &Value)| match value {
        Value::Number(number) => (name.clone(), float(number)),
        Value::Vector(numbers) => {
            (name.clone(), toml::Value::Array(numbers.iter().map(float).collect()))
        }
    };
    EffectTable {
        effect: cause.effect.clone(),
        joint: cause.joint,
        parameters: cause.parameters.iter().map(parameter).collect(),
        extra: toml::Table::new(),
    }
}
