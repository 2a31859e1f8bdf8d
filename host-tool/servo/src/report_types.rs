//! `report.json` of an arm of servos: format 2, judged on motion.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::contact::Contact;

/// `report.json`.
#[derive(Clone, Debug, Default, Serialize)]
#[allow(missing_docs)] // the names are the contract's
pub struct Report {
    pub format: u32,
    pub verdict: &'static str,
    pub causes: Vec<Cause>,
    pub alternatives: Vec<Alternative>,
    pub parameters_changed: Vec<ParameterChange>,
    pub remainder: Vec<Remainder>,
    #[serde(rename = "where")]
    pub places: Vec<Place>,
    pub gap: Gap,
    pub data: Data,
    pub untestable: Vec<Untestable>,
    pub remarks: Vec<String>,
    /// Seconds in which the arm pushes against something.
    pub contact: Vec<Contact>,
}

/// A cause that is named.
#[derive(Clone, Debug, Serialize)]
#[allow(missing_docs)]
pub struct Cause {
    pub effect: String,
    pub joint: usize,
    pub parameters: BTreeMap<String, Value>,
    pub parameter_intervals: BTreeMap<String, Interval>,
    pub probability: f64,
    pub confidence: f64,
    pub share: f64,
    pub share_interval: [f64; 2],
    pub shrinkage: f64,
    pub shrinkage_interval: [f64; 2],
    /// Shrinkage in each half of the confirming data.
    pub shrinkage_halves: [f64; 2],
}

/// A number or a vector.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
#[allow(missing_docs)]
pub enum Value {
    Number(f64),
    Vector(Vec<f64>),
}

/// An interval of a number, or of each component of a vector.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
#[allow(missing_docs)]
pub enum Interval {
    Number([f64; 2]),
    Vector(Vec<[f64; 2]>),
}

/// A cause that is not ruled out, or not shown.
#[derive(Clone, Debug, Serialize)]
#[allow(missing_docs)]
pub struct Alternative {
    pub effect: String,
    pub joint: usize,
    pub probability: f64,
    pub confidence: f64,
    pub instead_of: Option<usize>,
    pub share: f64,
    /// Why it is not named.
    pub why: String,
}

/// A parameter that the refit moved.
#[derive(Clone, Debug, Serialize)]
#[allow(missing_docs)]
pub struct ParameterChange {
    pub parameter: String,
    pub given: f64,
    pub found: f64,
    pub interval: [f64; 2],
    pub share: f64,
}

/// What no cause explains on a joint.
#[derive(Clone, Debug, Serialize)]
#[allow(missing_docs)]
pub struct Remainder {
    pub joint: usize,
    pub axis: &'static str,
    /// On a servo at rest this voltage is what its error of position is worth.
    #[serde(rename = "rms_V")]
    pub rms_v: f64,
    pub rms_rad: f64,
    pub share: f64,
    pub detail: String,
    pub nearest: Option<String>,
}

/// Where the gap lies.
#[derive(Clone, Debug, Serialize)]
#[allow(missing_docs)]
pub struct Place {
    pub joint: usize,
    pub axis: &'static str,
    pub share: f64,
    pub detail: String,
}

/// The size of the gap on the confirming logs, rms by joint.
#[derive(Clone, Debug, Default, Serialize)]
#[allow(missing_docs)]
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
    pub as_given_rad: Vec<f64>,
    pub refitted_rad: Vec<f64>,
    pub with_effects_rad: Vec<f64>,
    pub noise_floor_rad: Vec<f64>,
}

/// Which logs served for what.
#[derive(Clone, Debug, Default, Serialize)]
#[allow(missing_docs)]
pub struct Data {
    pub fit: Vec<String>,
    pub select: Vec<String>,
    pub confirm: Vec<String>,
}

/// What these logs cannot show.
#[derive(Clone, Debug, Serialize)]
#[allow(missing_docs)]
pub struct Untestable {
    pub effect: String,
    pub joint: usize,
    pub why: String,
}
