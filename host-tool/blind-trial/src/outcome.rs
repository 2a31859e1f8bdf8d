//! What a diagnosis made of a case, beside the truth.

use std::path::{Path, PathBuf};
use std::time::Instant;

use serde::Serialize;

use super::answer::Answer;
use super::case::{Case, Kind};
use super::cause::TrueCause;
use super::error::TrialError;
use super::logs;
use super::visibility::Visibility;
use diagnosis::{Cause, Report};
use recordings::Campaign;

/// Whatever diagnoses logs: the report, or why there is none.
pub type Diagnose<'a> = &'a dyn Fn(&Campaign) -> Result<Report, String>;

/// A case's truth and the answer.
#[derive(Clone, Debug, Serialize)]
pub struct Outcome {
    /// Number of the case.
    pub case: u32,
    /// What kind of truth it has.
    pub kind: Kind,
    /// The true causes.
    pub truth: Vec<TrueCause>,
    /// How much they show.
    pub visibility: Option<Visibility>,
    /// What the diagnosis said.
    pub answer: Answer,
    /// How long it took [s].
    pub seconds: f64,
    /// What the same diagnosis leaves of the command on the logs held out where the same
    /// robot does nothing but what its model holds, rms per joint [V]; `None` where that was
    /// not asked for.
    #[serde(rename = "ceiling_V")]
    pub ceiling_v: Option<Vec<f64>>,
}

/// How cases are run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RunSettings {
    /// Directory for the logs.
    pub out: PathBuf,
    /// Whether logs stay.
    pub keep_logs: bool,
    /// Whether the same robot without causes is diagnosed as well, for the ceiling.
    pub ceiling: bool,
}

/// Writes the logs of a case, reads them back and diagnoses them; the diagnosis sees
/// nothing else.
///
/// # Errors
/// Logs that cannot be recorded, written or read back. A diagnosis that fails is an answer.
pub fn diagnose_case(
    case: &Case,
    settings: &RunSettings,
    diagnose: Diagnose,
) -> Result<Outcome, TrialError> {
    let directory = logs::directory(&settings.out, case.number);
    let (answer, seconds) = answer_in(case, &directory, settings.keep_logs, diagnose)?;
    Ok(Outcome {
        case: case.number,
        kind: case.kind,
        truth: case.causes.clone(),
        visibility: case.visibility,
        ceiling_v: ceiling_v(case, settings, diagnose, &answer)?,
        answer,
        seconds,
    })
}

/// The answer, and how long it took [s].
pub(crate) fn answer_in(
    case: &Case,
    directory: &Path,
    keep_logs: bool,
    diagnose: Diagnose,
) -> Result<(Answer, f64), TrialError> {
    logs::write(case, directory)?;
    answer_to(directory, keep_logs, diagnose)
}

/// The answer to logs that are already written, and how long it took [s].
pub(crate) fn answer_to(
    directory: &Path,
    keep_logs: bool,
    diagnose: Diagnose,
) -> Result<(Answer, f64), TrialError> {
    let campaign = logs::read(directory)?;
    let began = Instant::now();
    let answer = Answer::of(|| diagnose(&campaign));
    let seconds = began.elapsed().as_secs_f64();
    if !keep_logs {
        logs::remove(directory)?;
    }
    Ok((answer, seconds))
}

/// What the refitted model leaves of the robot without causes.
fn ceiling_v(
    case: &Case,
    settings: &RunSettings,
    diagnose: Diagnose,
    own: &Answer,
) -> Result<Option<Vec<f64>>, TrialError> {
    let refitted = |answer: &Answer| answer.report().map(|report| report.gap.refitted_v.clone());
    if !settings.ceiling {
        return Ok(None);
    }
    if case.causes.is_empty() {
        return Ok(refitted(own));
    }
    let mut directory = logs::directory(&settings.out, case.number).into_os_string();
    directory.push("-without");
    let twin = case.with_causes(Vec::new());
    let (answer, _) = answer_in(&twin, Path::new(&directory), false, diagnose)?;
    Ok(refitted(&answer))
}

impl Outcome {
    /// Whether a cause that was named is true: effect and joint.
    pub fn is_true(&self, cause: &Cause) -> bool {
        self.truth.iter().any(|truth| truth.is(cause))
    }

    /// How many true causes were named.
    pub fn found(&self) -> usize {
        let is_found = |truth: &&TrueCause| self.answer.named().iter().any(|c| truth.is(c));
        self.truth.iter().filter(is_found).count()
    }

    /// Whether the answer is exactly that of a perfect diagnosis.
    pub fn is_right(&self) -> bool {
        match self.kind {
            Kind::None => self.answer.label() == "none",
            Kind::Foreign => self.answer.label() == "unknown",
            Kind::Single | Kind::Pair => {
                self.found() == self.truth.len() && self.answer.named().len() == self.truth.len()
            }
        }
    }
}
