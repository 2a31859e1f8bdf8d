//! Where a real robot differs from its model, what causes it, and how much of the gap goes
//! away when the cause is added.
//!
//! | module | what it holds, in the order in which data flow |
//! | --- | --- |
//! | [`criteria`] | every threshold |
//! | [`logs`] | the rig and its logs: which of them can be used, and their unbroken stretches |
//! | [`rows`] | filtered, whitened rows, and the noise in them |
//! | [`trial`] | what a hypothesis, a model with effects, leaves of the command |
//! | [`fit`] | a hypothesis linearised, fitted, and judged against the noise |
//! | [`search`] | every effect on every joint, one after the other |
//! | [`tables`] | curves over one axis: ceilings of effects, and what remains |
//! | [`model_faults`] | a sign, an order of joints, a home position, lengths that are not the robot's |
//! | [`verdict`] | what the search amounts to |
//! | [`gap_by_axis`] | where the gap lies, without any hypothesis |
//! | [`report`] | the report, in figures and words |

#![forbid(unsafe_code)]

pub mod criteria;
mod findings;
pub mod fit;
pub mod gap_by_axis;
pub mod logs;
pub mod model_faults;
mod model_file;
mod posterior;
pub mod quantity;
pub mod report;
mod result;
pub mod rows;
pub mod search;
#[cfg(any(test, feature = "synthetic"))]
pub mod synthetic;
pub mod tables;
pub mod trial;
pub mod verdict;

pub use criteria::Criteria;
pub use gap_by_axis::gap_by_axis;
pub use logs::subject::SubjectError;
pub use model_file::ModelFile;
pub use posterior::Posterior;
pub use report::sentence::sentence;
pub use result::*;

use fit::{doubt, preparation};
use logs::stretch::Stretch;
use logs::subject::Subject;
use logs::usable::Usable;
use model_faults::FoundFault;
use recordings::{ArmCampaign, Campaign, StepError, Trace};
use report::assembly::Assembly;
use rig::effects::Catalogue;
use rows::evidence::Evidence;
use search::found::Selection;
use search::selection;
use tables::remaining::with_remaining_tables;
use verdict::confirmed::Held;
use verdict::judgement::Judgement;
use verdict::told;

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

/// Diagnoses the logs of a campaign against the model in its robot file, with the effects of a
/// catalogue and by these criteria; `progress` hears what is under way.
///
/// ```no_run
/// use diagnosis::{Criteria, diagnose, sentence};
/// use files::{Dataset, RobotFile};
/// use recordings::Campaign;
/// use rig::effects::Catalogue;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let model = RobotFile::read("model.toml")?;
/// let campaign = Campaign::read(&Dataset::read("campaign")?, model)?;
/// let diagnosis = diagnose(&campaign, &Catalogue::standard(), &Criteria::default(), &|_| ())?;
/// println!("{}", sentence(&diagnosis));
/// # Ok(())
/// # }
/// ```
///
/// # Errors
/// Logs that do not fit the model's robot, or that cannot be used.
pub fn diagnose(
    campaign: &Campaign,
    catalogue: &Catalogue,
    criteria: &Criteria,
    progress: &dyn Fn(&str),
) -> Result<Diagnosis, DiagnosisError> {
    let subject = Subject::of(campaign, catalogue, criteria)?;
    let file = ModelFile::Robot(Box::new(campaign.robot_file.clone()));
    diagnosed(subject, &campaign.traces, &file, progress)
}

/// The share of the gap that each effect in the campaign's model has, told with its values, by the
/// measure of a report: what a search that errs nowhere would find. `None` where a refit fails.
///
/// # Errors
/// Logs or a model that cannot be used.
pub fn told_shares(
    campaign: &Campaign,
    catalogue: &Catalogue,
    criteria: &Criteria,
) -> Result<Vec<Option<f64>>, DiagnosisError> {
    let told = Subject::of(campaign, catalogue, criteria)?;
    Ok(told::shares(&told, &campaign.traces)?)
}

/// Diagnoses the logs of an arm of any kind, as [`diagnose`] does.
///
/// # Errors
/// Logs or a model that cannot be used; drives that are position servos.
pub fn diagnose_arm(
    campaign: &ArmCampaign,
    catalogue: &Catalogue,
    criteria: &Criteria,
    progress: &dyn Fn(&str),
) -> Result<Diagnosis, DiagnosisError> {
    let arm = &campaign.arm;
    let traces: Vec<Trace> = campaign.recordings.iter().map(|log| log.trace(arm)).collect();
    let subject = Subject::of_arm(arm, &traces, catalogue, criteria)?;
    diagnosed(subject, &traces, &ModelFile::Arm(Box::new(arm.clone())), progress)
}

fn diagnosed(
    mut subject: Subject,
    traces: &[Trace],
    file: &ModelFile,
    progress: &dyn Fn(&str),
) -> Result<Diagnosis, DiagnosisError> {
    let Usable { stretches, mut remarks } = Usable::of(traces, &subject)?;
    let mut searched = Searched::of(&subject, stretches.clone(), None, progress)?;
    if let Some((relative, found)) = searched.wider_doubt(&subject, &stretches, progress) {
        remarks.push(format!(
            "the parameters of the model are further off than {:.1} %: the doubt about them was taken \
             as {:.0} %, as by --model-doubt {relative:.2}; identify the model anew, and more can be said",
            100.0 * subject.criteria.prior.relative,
            100.0 * relative
        ));
        subject.doubt(relative);
        let near = searched.selection.refitted.linear.hypothesis.clone();
        searched = match found {
            Some(found) => found,
            None => Searched::of(&subject, stretches, Some(&near), progress)?,
        };
    }
    let Searched { evidence, selection, fault } = searched;
    let subject = &subject;
    progress("confirming on logs that chose nothing");
    let noise_v = preparation::noise_left_v(subject, &evidence, &selection.last);
    let judgement = Judgement::of(subject, selection, &noise_v);
    progress("fitting tables to what remains");
    let tables = Held::of(subject, &with_remaining_tables(subject, &judgement.last));
    let assembly = Assembly {
        subject,
        evidence: &evidence,
        judgement: &judgement,
        tables,
        traces,
        noise_v,
        fault,
    };
    Ok(assembly.diagnosis(file, remarks))
}

/// What a search finds by one doubt about the model.
struct Searched {
    evidence: Evidence,
    selection: Selection,
    fault: Option<FoundFault>,
}

impl Searched {
    fn of(
        subject: &Subject,
        stretches: Vec<Stretch>,
        near: Option<&trial::hypothesis::Hypothesis>,
        progress: &dyn Fn(&str),
    ) -> Result<Self, StepError> {
        progress("refitting the model");
        let (evidence, refitted) = preparation::prepared(subject, stretches, near)?;
        let selection = selection::select(subject, refitted, &[], progress);
        progress("trying whether the model itself is at fault");
        let fault = model_faults::find(subject, &evidence, &selection.refitted, &selection.last);
        let Some(found) = fault else { return Ok(Self { evidence, selection, fault: None }) };
        let effects = found.fault.as_effects(subject);
        let with =
            |effects| selection::select(subject, selection.refitted.clone(), effects, progress);
        let said = (!effects.is_empty()).then(|| with(&effects[..]));
        let (selection, fault) = match said.filter(|said| said.holds(&effects)) {
            Some(said) => (said, None),
            None => (selection.without_effects(), Some(found)),
        };
        Ok(Self { evidence, selection, fault })
    }

    /// A wider doubt that the logs show, with the causes found or, where much is left, with those that
    /// are found once parameters are all but free; and what was found by that doubt, if it was tried.
    fn wider_doubt(
        &self,
        subject: &Subject,
        stretches: &[Stretch],
        progress: &dyn Fn(&str),
    ) -> Option<(f64, Option<Self>)> {
        if self.fault.is_some() {
            return None;
        }
        let last = &self.selection.last.by_all_rows();
        if let Some(relative) = doubt::wider(subject, last) {
            return Some((relative, None));
        }
        let prior = &subject.criteria.prior;
        if last.stats.worst() <= prior.much_left {
            return None;
        }
        let mut free = subject.clone();
        free.doubt(prior.widest);
        let near = &self.selection.refitted.linear.hypothesis;
        let wide = Self::of(&free, stretches.to_vec(), Some(near), progress).ok()?;
        let wide_last = wide.selection.last.by_all_rows();
        let gains_more = wide_last.gain_over(last) > prior.least_gain;
        if wide.fault.is_some() || wide.selection.added.is_empty() || !gains_more {
            return None;
        }
        match doubt::seen(subject, &wide_last) {
            Some(relative) => Some((relative, None)),
            None => {
                doubt::had_hidden(subject, last, &wide_last).then_some((prior.widest, Some(wide)))
            }
        }
    }
}
