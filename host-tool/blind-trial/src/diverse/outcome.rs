//! What a diagnosis made of a diverse case, beside the truth.

use serde::Serialize;

use super::knowable::Known;
use crate::case::Kind;
use crate::cause::TrueCause;
use crate::claim::Claim;
use crate::reality::Reality;

/// A diverse case's truth and the answer.
#[derive(Clone, Debug, Serialize)]
pub struct DiverseOutcome {
    /// Number of the case.
    pub case: u32,
    /// What kind of truth it has.
    pub kind: Kind,
    /// The true causes, the largest first.
    pub truth: Vec<TrueCause>,
    /// What could be known of each.
    pub known: Vec<Known>,
    /// The share of each by the report's own measure, told with its values.
    pub told_shares: Vec<Option<f64>>,
    /// The rest of the robot, with its small effects.
    pub reality: Reality,
    /// What else is true of the robot against its model, and has a name.
    pub beside: Vec<TrueCause>,
    /// Whether the search was told the true causes first: not a blind answer.
    pub suspects_truth: bool,
    /// The verdict, or "failed".
    pub verdict: String,
    /// Why there is no report, where there is none.
    pub failure: Option<String>,
    /// The causes named, in the report's order.
    pub claims: Vec<Claim>,
    /// How long the diagnosis took [s].
    pub seconds: f64,
    /// Processor time of it [s].
    pub processor_seconds: f64,
    /// All that it said, as `report.json` has it.
    pub report: Option<serde_json::Value>,
}
