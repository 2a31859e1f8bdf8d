//! A diagnosis with all that pictures are drawn from.

use std::collections::BTreeMap;

use serde::Serialize;

pub use crate::findings::*;

use crate::criteria::Criteria;
use crate::model_file::ModelFile;
use crate::posterior::Posterior;
use files::Role;
use rig::effects::Catalogue;
use rig::plant::JointUnits;

/// A diagnosis: its report, what pictures are drawn from, and the amended model.
#[derive(Clone, Debug)]
pub struct Diagnosis {
    /// What `report.json` holds.
    pub report: Report,
    /// What is left of the command in every log, before and after.
    pub logs: Vec<LogResiduals>,
    /// The gap step by step, from the model as given to the noise floor.
    pub waterfall: Vec<Level>,
    /// Causes that were tried and are not in the verdict, the best first.
    pub rivals: Vec<Rival>,
    /// The model with the effects added, both refitted.
    pub model: ModelFile,
    /// What the logs leave open of that model; none where it was made up.
    pub posterior: Option<Posterior>,
    /// The effects that were tried, in which the names above are looked up.
    pub catalogue: Catalogue,
    /// The thresholds by which it was made.
    pub criteria: Criteria,
    /// Units of the joints by their numbers; volts and radians where none is named.
    pub units: BTreeMap<u8, JointUnits>,
}

impl Diagnosis {
    /// The units of a joint by its number; volts and radians for the whole robot.
    pub fn units_of(&self, joint: u8) -> JointUnits {
        self.units.get(&joint).copied().unwrap_or_default()
    }
}

/// A step of the waterfall.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Level {
    /// What is in the model at this step, "refitted" say.
    pub name: String,
    /// What is left on the logs held out, rms per joint of the rig [V].
    pub rms_v: Vec<f64>,
}

/// A cause that was tried and lost.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Rival {
    /// Name in the catalogue.
    pub effect: String,
    /// Joint, 1 to 3; 0 for the whole robot.
    pub joint: u8,
    /// Its best parameters.
    pub parameters: BTreeMap<String, Value>,
    /// Part of the gap's excess over the floor that it explains, 0 to 1.
    pub explained: f64,
    /// Why it lost, in words.
    pub why: String,
}

/// What is left of the command in one log.
#[derive(Clone, Debug, PartialEq)]
pub struct LogResiduals {
    /// File name.
    pub file: String,
    /// What the log was for.
    pub role: Role,
    /// Instants, evenly spaced but for gaps [s].
    pub time_s: Vec<f64>,
    /// The rig's joints.
    pub joints: Vec<JointResiduals>,
}

/// What is left of one joint's command; residuals are measured less reconstructed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JointResiduals {
    /// Joint, 1 to 3.
    pub joint: u8,
    /// Angle [rad].
    pub position_rad: Vec<f64>,
    /// Velocity [rad/s].
    pub velocity_rad_per_s: Vec<f64>,
    /// Acceleration [rad/s^2].
    pub acceleration_rad_per_s2: Vec<f64>,
    /// Coriolis and gravity torque on the joint [Nm].
    pub load_nm: Vec<f64>,
    /// Command, filtered as the residuals are [V].
    pub command_v: Vec<f64>,
    /// Residual of the model as given [V].
    pub given_v: Vec<f64>,
    /// Residual of the refitted model [V].
    pub refitted_v: Vec<f64>,
    /// Residual of the refitted model with the effects [V].
    pub with_effects_v: Vec<f64>,
    /// What noise alone would leave, rms [V].
    pub noise_floor_v: f64,
}
