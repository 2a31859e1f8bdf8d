//! Answers of a trial that was stopped.

use std::path::Path;

use serde::Deserialize;

use super::beside::beside;
use super::draw::DiverseCase;
use super::outcome::DiverseOutcome;
use super::output::LINES;
use crate::claim::Claim;
use crate::error::TrialError;
use files::Problem;

/// What a line of `diverse-trial.jsonl` tells of a diagnosis, and of what.
#[derive(Clone, Debug, Deserialize)]
pub struct Earlier {
    case: u32,
    truth: serde_json::Value,
    told_shares: Vec<Option<f64>>,
    #[serde(default)]
    suspects_truth: bool,
    verdict: String,
    failure: Option<String>,
    claims: Vec<Claim>,
    seconds: f64,
    processor_seconds: f64,
    report: Option<serde_json::Value>,
}

impl Earlier {
    /// The answers in the directory of a trial; none where it has none. A last line that was cut short is left out.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn read(directory: &Path) -> Result<Vec<Self>, TrialError> {
        let path = directory.join(LINES);
        if !path.exists() {
            return Ok(Vec::new());
        }
        let text =
            std::fs::read_to_string(&path).map_err(|e| Problem::Unreadable(e).in_file(&path))?;
        Ok(text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect())
    }

    /// The outcome of a case that is the same, by its number and its causes, unless its search was told the truth.
    pub fn outcome(&self, DiverseCase { case, known }: &DiverseCase) -> Option<DiverseOutcome> {
        let is_same = self.case == case.number && self.truth == serde_json::json!(case.causes);
        let reality = case.reality.clone().filter(|_| is_same && !self.suspects_truth)?;
        Some(DiverseOutcome {
            case: case.number,
            kind: case.kind,
            truth: case.causes.clone(),
            known: known.clone(),
            told_shares: self.told_shares.clone(),
            suspects_truth: self.suspects_truth,
            reality,
            beside: beside(case),
            verdict: self.verdict.clone(),
            failure: self.failure.clone(),
            claims: self.claims.clone(),
            seconds: self.seconds,
            processor_seconds: self.processor_seconds,
            report: self.report.clone(),
        })
    }
}
