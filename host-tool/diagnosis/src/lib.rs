//! Where a real robot differs from its model, what causes it, and how much of the gap goes
//! away when the cause is added.

#![forbid(unsafe_code)]

mod assembly;
pub mod candidate;
mod detectable;
mod doubt;
mod encoder_step;
pub mod even_clock;
pub mod evidence;
pub mod fit;
pub mod harmonics;
mod judgement;
pub mod linearisation;
mod link_motion;
mod log_checks;
mod logs;
mod misfit;
mod motion_gap;
pub mod noise;
mod parts;
pub mod places;
pub mod preparation;
pub mod quantity;
mod reading;
pub mod rest;
mod result;
pub mod row_filter;
pub mod search;
pub mod selection;
pub mod sentence;
mod shake;
mod shrinkage;
mod slopes;
pub mod stretch;
pub mod subject;
#[cfg(any(test, feature = "synthetic"))]
pub mod synthetic;
pub mod unknowns;
pub mod voltage;

pub use places::places;
pub use result::*;
pub use sentence::sentence;
pub use subject::SubjectError;

use assembly::Assembly;
use logs::Usable;
use subject::Subject;

use recordings::{Campaign, StepError};

/// Why there is no diagnosis.
#[derive(Debug, thiserror::Error)]
pub enum DiagnosisError {
    /// The model cannot be used.
    #[error(transparent)]
    Subject(#[from] SubjectError),
    /// The logs cannot be used.
    #[error(transparent)]
    Logs(#[from] StepError),
}

/// Diagnoses the logs of a campaign against the model in its robot file; `progress` hears what
/// is under way.
///
/// # Errors
/// Logs that do not fit the model's robot, or that cannot be used.
pub fn diagnose(campaign: &Campaign, progress: &dyn Fn(&str)) -> Result<Diagnosis, DiagnosisError> {
    let mut subject = Subject::of(campaign)?;
    encoder_step::find(&mut subject.known, &campaign.traces);
    let usable = Usable::of(campaign, &subject)?;
    progress("refitting the model");
    let (evidence, refitted) = preparation::prepared(&subject, usable.stretches)?;
    let selection = selection::select(&evidence, &subject, refitted, progress);
    progress("judging");
    let assembly = Assembly {
        subject: &subject,
        evidence: &evidence,
        selection: &selection,
        traces: &campaign.traces,
        noise: preparation::noise_left(&subject, &evidence, &selection),
    };
    Ok(assembly.diagnosis(&campaign.robot_file, usable.remarks))
}
