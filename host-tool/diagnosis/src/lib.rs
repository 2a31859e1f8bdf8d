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

mod constants;
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
mod searched;
mod settled;
#[cfg(any(test, feature = "synthetic"))]
pub mod synthetic;
pub mod tables;
pub mod trial;
pub mod verdict;

pub use criteria::{Criteria, Doubt};
pub use gap_by_axis::gap_by_axis;
pub use logs::subject::SubjectError;
pub use model_file::ModelFile;
pub use posterior::Posterior;
pub use report::sentence::sentence;
pub use result::*;

use files::EffectTable;
use fit::gears::ask_for_loss;
use fit::preparation::{self, prepared};
use fit::warmth::{ask_for_warmth, may_warm};
use logs::stretch::Stretch;
use logs::subject::Subject;
use logs::usable::Usable;
use recordings::{ArmCampaign, Campaign, StepError, Trace};
use report::assembly::Assembly;
use rig::effects::Catalogue;
use searched::Searched;
use settled::{Settled, settled};
use tables::remaining::with_remaining_tables;
use verdict::held::Held;
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
    diagnose_suspecting(campaign, catalogue, criteria, &[], progress)
}

/// The same, with effects that every search tries first, by their values; they stay where the logs bear them out. Few rivals
/// are tried in the place of one that stays, so its probability is higher than that of a cause which a search finds.
///
/// # Errors
/// Likewise, and effects that the robot cannot have.
pub fn diagnose_suspecting(
    campaign: &Campaign,
    catalogue: &Catalogue,
    criteria: &Criteria,
    suspected: &[EffectTable],
    progress: &dyn Fn(&str),
) -> Result<Diagnosis, DiagnosisError> {
    let mut subject = Subject::of(campaign, catalogue, criteria)?;
    subject.suspect(suspected)?;
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
    open_what_logs_ask_for(&mut subject, &stretches)?;
    let given = subject.criteria.prior.doubt();
    let Settled { subject, searched, early_part, doubt } = settled(&subject, &stretches, progress)?;
    remarks.extend(doubt.map(|doubt| report::doubt::words(given, doubt)));
    if early_part > 0.0 {
        remarks.push(early_words(early_part));
    }
    let Searched { evidence, selection, fault, .. } = searched;
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

/// Opens what a model may lack without a cause of the catalogue, where a refit asks for it.
fn open_what_logs_ask_for(subject: &mut Subject, stretches: &[Stretch]) -> Result<(), StepError> {
    if !subject.may_share_gear_loss() && !may_warm(subject, stretches) {
        return Ok(());
    }
    let (evidence, refitted) = prepared(subject, stretches.to_vec(), None)?;
    subject.gears_lose = ask_for_loss(subject, &evidence, &refitted);
    subject.warms = ask_for_warmth(subject, &refitted);
    Ok(())
}

fn early_words(part: f64) -> String {
    format!(
        "the joints seem to be driven {:.0} % of a sample period early: commands were taken as sampled at their rows, \
         not held from there on; log the mean over each interval, and faster motion can be told",
        100.0 * part
    )
}
