//! What a diagnosis says, as `report.json` holds it.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::criteria::Criteria;
use files::{RobotFile, Role};
use rig::effects::Catalogue;

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
    pub model: RobotFile,
    /// The effects that were tried, in which the names above are looked up.
    pub catalogue: Catalogue,
    /// The thresholds by which it was made.
    pub criteria: Criteria,
}

/// `report.json`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// Version of this layout.
    pub format: u32,
    /// What was found.
    pub verdict: Verdict,
    /// The causes that are added to the model, in order.
    pub causes: Vec<Cause>,
    /// Causes that the logs do not rule out.
    pub alternatives: Vec<Alternative>,
    /// Where the gap of the refitted model lies, largest first.
    #[serde(rename = "where")]
    pub gap_shares: Vec<GapShare>,
    /// The size of the gap.
    pub gap: Gap,
    /// Effects that these logs cannot show.
    pub untestable: Vec<Untestable>,
    /// The smallest size of each effect that these logs would have shown.
    pub detectable: Vec<Detectable>,
    /// What else a reader must know, in sentences.
    pub remarks: Vec<String>,
}

/// The verdict in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// At least one cause is named.
    Effect,
    /// No gap above the noise that the refitted model leaves.
    None,
    /// A gap that nothing in the catalogue explains.
    Unknown,
}

/// A cause that is named.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Cause {
    /// Name in the catalogue.
    pub effect: String,
    /// Joint, 1 to 3; 0 for the whole robot.
    pub joint: u8,
    /// Its parameters, by the names of the catalogue.
    pub parameters: BTreeMap<String, Value>,
    /// 0 to 1.
    pub confidence: f64,
    /// 1 - rms with it / rms without it, of the command on the logs held out.
    pub shrinkage: f64,
    /// 95 % interval of the shrinkage.
    pub shrinkage_interval: [f64; 2],
}

/// A parameter: a number, or a vector.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Value {
    /// One number.
    Number(f64),
    /// A vector, such as a force.
    Vector(Vec<f64>),
}

/// A cause that is not ruled out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Alternative {
    /// Name in the catalogue.
    pub effect: String,
    /// Joint, 1 to 3; 0 for the whole robot.
    pub joint: u8,
    /// 0 to 1.
    pub confidence: f64,
}

/// The part of the gap that varies with one axis on one joint.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GapShare {
    /// Joint, 1 to 3.
    pub joint: u8,
    /// What the gap varies with.
    pub axis: Axis,
    /// Part of the whole gap's square that this explains, 0 to 1.
    pub share: f64,
    /// More, in words.
    pub detail: String,
}

/// What a gap varies with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Axis {
    /// Joint angle.
    Position,
    /// Joint velocity.
    Velocity,
    /// Joint acceleration.
    Acceleration,
    /// Commanded voltage.
    Command,
    /// Gravity and Coriolis torque on the joint.
    Load,
    /// Time since the log began.
    Time,
    /// A band of frequencies.
    Frequency,
    /// A constant.
    Offset,
}

/// The gap on the logs held out, rms per joint of the rig.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[allow(missing_docs)] // the names say it, and are the contract's
pub struct Gap {
    #[serde(rename = "as_given_V")]
    pub as_given_v: Vec<f64>,
    #[serde(rename = "refitted_V")]
    pub refitted_v: Vec<f64>,
    #[serde(rename = "with_effects_V")]
    pub with_effects_v: Vec<f64>,
    #[serde(rename = "noise_floor_V")]
    pub noise_floor_v: Vec<f64>,
    pub refitted_rad: Vec<f64>,
    pub with_effects_rad: Vec<f64>,
}

/// An effect that the logs cannot show, or not apart from another.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Untestable {
    /// Name in the catalogue.
    pub effect: String,
    /// Joint, 1 to 3; 0 for the whole robot.
    pub joint: u8,
    /// Why, and which experiment would show it.
    pub why: String,
}

/// The smallest size of an effect that the logs would have shown.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Detectable {
    /// Name in the catalogue.
    pub effect: String,
    /// Joint, 1 to 3; 0 for the whole robot.
    pub joint: u8,
    /// The parameter that says its size.
    pub parameter: String,
    /// That parameter's smallest value that would have been seen.
    pub size: f64,
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
