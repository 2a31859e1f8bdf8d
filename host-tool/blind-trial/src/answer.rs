//! What a diagnosis said of a case.

use std::panic::{AssertUnwindSafe, catch_unwind};

use diagnosis::{Cause, Report, Verdict};
use serde::Serialize;

/// What a diagnosis said.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Answer {
    /// Its report.
    Report(Box<Report>),
    /// Why there is none.
    Failed(String),
}

impl Answer {
    /// Of a diagnosis; one that panics has failed, and the trial goes on.
    pub fn of(diagnose: impl FnOnce() -> Result<Report, String>) -> Self {
        match catch_unwind(AssertUnwindSafe(diagnose)) {
            Ok(Ok(report)) => Self::Report(Box::new(report)),
            Ok(Err(why)) => Self::Failed(why),
            Err(_) => Self::Failed("it panicked".into()),
        }
    }

    /// Why there is no report, where there is none.
    pub fn failure(&self) -> Option<&str> {
        match self {
            Self::Failed(why) => Some(why),
            Self::Report(_) => None,
        }
    }

    /// The verdict as `report.json` writes it, or "failed".
    pub fn verdict(&self) -> String {
        let verdict = self.report().map(|report| serde_json::json!(report.verdict));
        verdict.as_ref().and_then(|word| word.as_str()).unwrap_or("failed").to_owned()
    }

    /// The report, where there is one.
    pub fn report(&self) -> Option<&Report> {
        match self {
            Self::Report(report) => Some(report),
            Self::Failed(_) => None,
        }
    }

    /// The causes that the verdict names; none unless it is "effect" or "partial".
    pub fn named(&self) -> &[Cause] {
        match self.report() {
            Some(Report { verdict: Verdict::Effect | Verdict::Partial, causes, .. }) => causes,
            _ => &[],
        }
    }

    /// The first cause's name, or "none", "unknown" or "failed".
    pub fn label(&self) -> &str {
        match self.report().map(|report| report.verdict) {
            Some(Verdict::Effect | Verdict::Partial) => {
                self.named().first().map_or("unknown", |cause| &cause.effect)
            }
            Some(Verdict::None) => "none",
            Some(Verdict::Unknown) => "unknown",
            None => "failed",
        }
    }
}
