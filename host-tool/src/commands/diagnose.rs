//! `rrr diagnose`: what causes the gap between a real robot and its model.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::failure::Failure;
use crate::output_files::{create_directory, json, write_text};
use crate::provenance::provenance;
use crate::say;
use crate::terminal::answer::answer;
use crate::terminal::progress::Steps;
use diagnosis::report::samples::SAMPLES;
use diagnosis::sentence;
use diagnosis::{self, Criteria, Diagnosis, DiagnosisError, SubjectError};
use files::{ArmFile, Dataset, RobotFile};
use recordings::{ArmCampaign, Campaign};
use report::Provenance;
use report::diagnosis_page::diagnosis_page;
use report::diagnosis_page::tables::{CAUSES, cause_rows};
use rig::effects::Catalogue;

/// What `rrr diagnose` takes: a diagnosis to make, or the wish to see its thresholds.
#[derive(Debug, Args)]
pub struct Choice {
    /// Print all thresholds with their meaning and default, as --criteria takes them, and end.
    #[arg(long, exclusive = true)]
    pub print_criteria: bool,
    /// The diagnosis to make.
    #[command(flatten)]
    pub diagnosis: Option<Arguments>,
}

/// Arguments of a diagnosis.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The data set: a directory with dataset.toml and its logs.
    #[arg(value_name = "DATASET")]
    pub dataset: PathBuf,
    /// The model whose gap is to be explained.
    #[arg(long, value_name = "MODEL.toml")]
    pub model: PathBuf,
    /// Directory for report.json, report.html, model.toml, the model with the effects added, and
    /// samples.csv, parameters drawn from what the logs leave open.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Thresholds that replace the defaults, as TOML; what it does not name keeps its default.
    #[arg(long, value_name = "FILE")]
    pub criteria: Option<PathBuf>,
    /// How far the parameters of the model may be off, in parts of themselves: 0.025 after an
    /// identification, 0.2 for a model from drawings.
    #[arg(long, value_name = "PART", value_parser = doubt)]
    pub model_doubt: Option<f64>,
}

/// A part between nothing and all.
fn doubt(text: &str) -> Result<f64, String> {
    let part: f64 = text.parse().map_err(|_| format!("`{text}` is no number"))?;
    match part > 0.0 && part <= 1.0 {
        true => Ok(part),
        false => Err("give a part of the parameters above 0, at most 1: 0.2 for 20 %".into()),
    }
}

/// Runs the command.
///
/// # Errors
/// Files that cannot be used or written, or logs that do not fit the model's robot.
pub fn run(choice: &Choice) -> Result<(), Failure> {
    match &choice.diagnosis {
        Some(arguments) => diagnose(arguments).map(drop),
        None => {
            print!("{}", Criteria::default().to_toml());
            Ok(())
        }
    }
}

/// Makes a diagnosis, for those who go on with it.
///
/// # Errors
/// Those of [`run`].
pub fn diagnose(arguments: &Arguments) -> Result<Diagnosis, Failure> {
    refuse_to_replace(&arguments.model, &arguments.out.join(MODEL))?;
    let criteria = arguments.criteria.as_deref().map(Criteria::read).transpose()?;
    let mut criteria = criteria.unwrap_or_default();
    if let Some(doubt) = arguments.model_doubt {
        criteria.prior.hold_at(doubt);
    }
    let steps = Steps::new();
    let diagnosis = judge(&arguments.dataset, &arguments.model, &criteria, &|what| steps.at(what))?;
    steps.at("drawing the pictures");
    write(&diagnosis, &arguments.out, &provenance(&arguments.model, &arguments.dataset))?;
    steps.finish();
    say!("{}", in_words(&diagnosis).trim_end());
    say!("\nPictures: {}", arguments.out.join(PAGE).display());
    answer(&diagnosis.report)?;
    Ok(diagnosis)
}

/// The diagnosis of a data set by a model file, of whichever format; `progress` hears what is under
/// way.
///
/// # Errors
/// Files that cannot be used, or logs that do not fit the model's robot.
pub fn judge(
    dataset: &Path,
    model: &Path,
    criteria: &Criteria,
    progress: &dyn Fn(&str),
) -> Result<Diagnosis, Failure> {
    progress("reading the logs");
    match ArmFile::is_at(model) {
        true => of_arm(dataset, model, criteria, progress),
        false => of_robot(dataset, model, criteria, progress),
    }
}

/// The diagnosis of the three-joint robot, or of a rig of one joint.
fn of_robot(
    dataset: &Path,
    model: &Path,
    criteria: &Criteria,
    progress: &dyn Fn(&str),
) -> Result<Diagnosis, Failure> {
    let model = RobotFile::read(model)?;
    let campaign = Campaign::read(&Dataset::read(dataset)?, model)?;
    let catalogue = Catalogue::standard();
    let mut diagnosis = diagnosis::diagnose(&campaign, &catalogue, criteria, progress)?;
    diagnosis.report.remarks.extend(campaign.notes);
    Ok(diagnosis)
}

/// The diagnosis of an arm of any kind.
fn of_arm(
    dataset: &Path,
    model: &Path,
    criteria: &Criteria,
    progress: &dyn Fn(&str),
) -> Result<Diagnosis, Failure> {
    let arm = ArmFile::read(model)?;
    let catalogue = Catalogue::of_arm(arm.joints.len());
    let mut remarks = arm.remarks();
    let dataset = Dataset::read(dataset)?;
    let (campaign, mut notes) = ArmCampaign::read_with_notes(&dataset, arm)?;
    let mut diagnosis = diagnosis::diagnose_arm(&campaign, &catalogue, criteria, progress)?;
    diagnosis.report.remarks.append(&mut remarks);
    diagnosis.report.remarks.append(&mut notes);
    Ok(diagnosis)
}

impl From<DiagnosisError> for Failure {
    fn from(error: DiagnosisError) -> Self {
        match error {
            DiagnosisError::Logs(error) => error.into(),
            DiagnosisError::Subject(SubjectError::File(error)) => (*error).into(),
            DiagnosisError::Subject(error @ SubjectError::Effect(_)) => {
                Self::new(error.to_string(), "correct the table, or take it out")
            }
            DiagnosisError::Subject(error @ SubjectError::Suspected(_)) => {
                Self::new(error.to_string(), "docs/effects.md lists the catalogue")
            }
            DiagnosisError::Subject(SubjectError::Plant(error)) => error.into(),
        }
    }
}

/// The report's name for programs.
pub const REPORT: &str = "report.json";
/// The report's name in the directory of a diagnosis.
pub const PAGE: &str = "report.html";
/// The table's of models drawn from what the logs leave open.
pub const TABLE: &str = "samples.csv";
/// The amended model's.
pub const MODEL: &str = "model.toml";

/// The amended model must not take the place of the one that is judged.
///
/// # Errors
/// It would.
pub fn refuse_to_replace(model: &Path, amended: &Path) -> Result<(), Failure> {
    let same = match (model.canonicalize(), amended.canonicalize()) {
        (Ok(model), Ok(amended)) => model == amended,
        _ => false,
    };
    if same {
        let message = format!("{}: the amended model would replace it", model.display());
        return Err(Failure::new(message, "give another --out"));
    }
    Ok(())
}

/// Writes report.json, report.html, model.toml and samples.csv into a directory, which is made.
///
/// All are drawn up before the first is written; each is written whole or not at all.
///
/// # Errors
/// The directory cannot be made, or a file not be written.
pub fn write(
    diagnosis: &Diagnosis,
    directory: &Path,
    provenance: &Provenance,
) -> Result<(), Failure> {
    let path = directory.join(REPORT);
    let report = json(&diagnosis.report, &path)? + "\n";
    let mut page = diagnosis_page(diagnosis);
    page.provenance(provenance);
    create_directory(directory)?;
    if let Some(posterior) = &diagnosis.posterior {
        write_text(&posterior.table(SAMPLES, 1), &directory.join(TABLE))?;
    }
    diagnosis.model.write(directory.join(MODEL))?;
    page.write(&directory.join(PAGE))?;
    write_text(&report, &path)
}

/// The sentence, the table of causes and the remarks, as they go to the terminal.
pub fn in_words(diagnosis: &Diagnosis) -> String {
    let report = &diagnosis.report;
    let mut text = format!("{}\n", sentence(diagnosis));
    if !report.causes.is_empty() {
        text += &table(diagnosis);
    }
    for remark in &report.remarks {
        text += &format!("  note: {remark}\n");
    }
    text
}

fn table(diagnosis: &Diagnosis) -> String {
    let line = |cells: &[&str]| match cells {
        [cause, joint, share, probability, shrinkage, parameters] => format!(
            "  {cause:22} {joint:>5}  {share:18}  {probability:>11}  {shrinkage:18}  {parameters}\n"
        ),
        cells => cells.join("  "),
    };
    let rows = cause_rows(diagnosis);
    let lines = rows.iter().map(|row| line(&row.iter().map(String::as_str).collect::<Vec<_>>()));
    format!("\n{}{}", line(&CAUSES), lines.collect::<String>())
}
