//! `rrr diagnose` on an arm of position servos, judged on motion.

use std::path::Path;

use diagnosis::Report;
use files::{ArmFile, Dataset};
use recordings::ArmCampaign;
use report::servo_page::servo_page;
use servo::{
    Outcome, ServoError, Settings, is_servo_arm, model_file, report::report, report_words::in_words,
};

use super::diagnose::{Arguments, Choice, MODEL, PAGE, REPORT, refuse_to_replace};
use crate::failure::Failure;
use crate::output_files::{create_directory, json, write_text};
use crate::provenance::provenance;
use crate::say;
use crate::terminal::answer::answer;
use crate::terminal::progress::Steps;

/// The arguments of a diagnosis whose model is one of an arm of position servos.
pub fn wanted(choice: &Choice) -> Option<&Arguments> {
    let arguments = choice.diagnosis.as_ref()?;
    is_judged_on_motion(&arguments.model).then_some(arguments)
}

/// Whether a model file is that of an arm of position servos; one that cannot be read is not.
pub fn is_judged_on_motion(model: &Path) -> bool {
    ArmFile::is_at(model) && ArmFile::read(model).is_ok_and(|arm| is_servo_arm(&arm))
}

impl From<ServoError> for Failure {
    fn from(error: ServoError) -> Self {
        match error {
            ServoError::File(error) => (*error).into(),
            error => Self::new(error.to_string(), error.hint()),
        }
    }
}

/// Runs the command.
///
/// # Errors
/// Files that cannot be used or written, or logs that do not fit the arm.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let out = &arguments.out;
    refuse_to_replace(&arguments.model, &out.join(MODEL))?;
    let steps = Steps::new();
    let (outcome, mut report) =
        judge(&arguments.dataset, &arguments.model, &|what| steps.at(what))?;
    report.remarks.extend(without_part(arguments));
    steps.at("drawing the pictures");
    let path = out.join(REPORT);
    let text = json(&report, &path)? + "\n";
    let mut page = servo_page(&outcome, &report);
    page.provenance(&provenance(&arguments.model, &arguments.dataset));
    create_directory(out)?;
    model_file::model_file(&outcome).write(out.join(MODEL))?;
    page.write(&out.join(PAGE))?;
    write_text(&text, &path)?;
    steps.finish();
    say!("{}", in_words(&report).trim_end());
    say!("\nPictures: {}", out.join(PAGE).display());
    answer(&report)
}

/// What is said of options that have no part in such a diagnosis.
fn without_part(arguments: &Arguments) -> Option<String> {
    let given = [
        arguments.criteria.as_ref().map(|_| "--criteria"),
        arguments.model_doubt.map(|_| "--model-doubt"),
    ];
    let given: Vec<&str> = given.into_iter().flatten().collect();
    let what = "no part in the diagnosis of an arm of position servos, whose settings are its own";
    (!given.is_empty()).then(|| format!("{} had {what}", given.join(" and ")))
}

/// The diagnosis of a data set by the model of such an arm; `progress` hears what is under way.
///
/// # Errors
/// Files that cannot be used, or logs that do not fit the arm.
pub fn judge(
    dataset: &Path,
    model: &Path,
    progress: &dyn Fn(&str),
) -> Result<(Outcome, Report), Failure> {
    progress("reading the logs");
    let arm = ArmFile::read(model)?;
    let (campaign, mut notes) = ArmCampaign::read_with_notes(&Dataset::read(dataset)?, arm)?;
    let outcome = Outcome::of(&campaign, &Settings::default(), progress)?;
    let mut report = report(&outcome);
    report.remarks.append(&mut notes);
    Ok((outcome, report))
}
