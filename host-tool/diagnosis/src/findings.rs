//! What a diagnosis says, as `report.json` holds it: of arms whose commands are judged and of those
//! whose motion is.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

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
    /// What the refit alone moved, largest share first.
    pub parameters_changed: Vec<ParameterChange>,
    /// What no cause explains, largest first.
    pub remainder: Vec<Remainder>,
    /// Where the gap of the refitted model lies, largest first.
    #[serde(rename = "where")]
    pub gap_shares: Vec<GapShare>,
    /// The size of the gap.
    pub gap: Gap,
    /// Which logs served for what.
    pub data: DataParts,
    /// Effects that these logs cannot show.
    pub untestable: Vec<Untestable>,
    /// The smallest size of each effect that these logs would have shown.
    pub detectable: Vec<Detectable>,
    /// What else a reader must know, in sentences.
    pub remarks: Vec<String>,
    /// What is wrong with the model itself; then no cause is named.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub model_fault: Option<ModelFaultFound>,
    /// Seconds in which the arm pushes against something; looked for where motion is judged.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact: Option<Vec<Contact>>,
}

/// A fault of the model as given that explains the gap.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ModelFaultFound {
    /// What is wrong, and what to do.
    pub what: String,
    /// Part of the squares above the noise of train logs that goes when it is put right, with what
    /// parameters are away from the model as given.
    pub explained: f64,
}

/// The verdict in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// The causes named take nine tenths of the gap, and what remains is at the noise or drawn as
    /// tables.
    Effect,
    /// At least one cause is named, and something else remains.
    Partial,
    /// No gap above the noise that the refitted model leaves.
    None,
    /// A gap, and no cause that is confirmed.
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
    /// 95 % intervals of these.
    pub parameter_intervals: BTreeMap<String, Interval>,
    /// Probability that this is a cause, given all that was tried, 0 to 1.
    pub probability: f64,
    /// The same.
    pub confidence: f64,
    /// Part of the gap's squares above the noise that goes when it is added, on the confirming
    /// logs, on the joint where it acts.
    pub share: f64,
    /// 95 % interval of the share.
    pub share_interval: [f64; 2],
    /// 1 - rms with it / rms without it, of the command on the confirming logs.
    pub shrinkage: f64,
    /// 95 % interval of the shrinkage.
    pub shrinkage_interval: [f64; 2],
    /// Shrinkage in each half of the confirming data; where motion is judged.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shrinkage_halves: Option<[f64; 2]>,
}

/// A parameter: a number, or a vector.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Value {
    /// One number.
    Number(f64),
    /// A vector, such as a force.
    Vector(Vec<f64>),
}

/// An interval of a number, or of each component of a vector.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Interval {
    /// That of a number: from, to.
    Number([f64; 2]),
    /// Those of a vector's components.
    Vector(Vec<[f64; 2]>),
}

/// A parameter that the refit moved.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParameterChange {
    /// Its name in the model file, `friction[2].alpha2_V_s_per_rad` say.
    pub parameter: String,
    /// Its value in the model as given; what was thought likely before the refit, where that does not tell it.
    pub given: f64,
    /// Whether the model tells it.
    #[serde(skip)]
    pub is_given: bool,
    /// Its value after the refit.
    pub found: f64,
    /// 95 % interval of that.
    pub interval: [f64; 2],
    /// Part of the squares between the model as given and refitted that it takes.
    pub share: f64,
}

/// What no cause explains, on one joint over one axis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Remainder {
    /// Joint, 1 to 3.
    pub joint: u8,
    /// What it varies with.
    pub axis: Axis,
    /// Its size, rms [V].
    #[serde(rename = "rms_V")]
    pub rms_v: f64,
    /// The same of position, simulated from the goals [rad]; where motion is judged.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rms_rad: Option<f64>,
    /// Part of the gap's squares above the noise.
    pub share: f64,
    /// More, in words.
    pub detail: String,
    /// Its course over the axis.
    pub curve: RemainderCurve,
    /// The effect that came nearest, if any was tried there.
    pub nearest: Option<String>,
}

/// The course of a remainder.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct RemainderCurve {
    /// Where on the axis, in its unit.
    pub x: Vec<f64>,
    /// What remains there [V].
    #[serde(rename = "y_V")]
    pub y_v: Vec<f64>,
    /// Standard deviation of that [V].
    #[serde(rename = "deviation_V")]
    pub deviation_v: Vec<f64>,
}

/// Files that served for fitting, for choosing among hypotheses, and for confirming the choice.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct DataParts {
    /// Parameters are fitted to these.
    pub fit: Vec<String>,
    /// Hypotheses are chosen by pieces of these that they were not fitted to.
    pub select: Vec<String>,
    /// Shares and intervals come from these, at which no choice looks.
    pub confirm: Vec<String>,
}

/// A rival of a cause that is not ruled out, or an effect that was found and is not named.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Alternative {
    /// Name in the catalogue.
    pub effect: String,
    /// Joint, 1 to 3; 0 for the whole robot.
    pub joint: u8,
    /// 0 to 1.
    pub probability: f64,
    /// The same.
    pub confidence: f64,
    /// Which of the causes it could stand for, from 0; none where it is none of theirs.
    pub instead_of: Option<usize>,
    /// Part of the gap's squares above the noise that it would take.
    pub share: f64,
    /// Why it is not named; none where it could stand for a cause.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why: Option<String>,
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
    #[serde(rename = "with_tables_V")]
    pub with_tables_v: Vec<f64>,
    #[serde(rename = "noise_floor_V")]
    pub noise_floor_v: Vec<f64>,
    pub refitted_rad: Vec<f64>,
    pub with_effects_rad: Vec<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub as_given_rad: Vec<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub noise_floor_rad: Vec<f64>,
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

/// Seconds in which the arm pushes against something.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Contact {
    /// The log.
    pub file: String,
    /// From and to, margins included [s].
    pub seconds: [f64; 2],
    /// The joint (from 1) that is held furthest from where it would be, by its own deviation.
    pub joint: u8,
}
