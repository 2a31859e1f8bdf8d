//! `rrr diagnose` on an arm of position servos, judged on motion.

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
    let is_arm = ArmFile::is_at(&arguments.model);
    let arm = is_arm.then(|| ArmFile::read(&arguments.model).ok()).flatten()?;
    is_servo_arm(&arm).then_some(arguments)
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
    steps.at("reading the logs");
    let arm = ArmFile::read(&arguments.model)?;
    let dataset = Dataset::read(&arguments.dataset)?;
    let (campaign, mut notes) = ArmCampaign::read_with_notes(&dataset, arm)?;
    let outcome = Outcome::of(&campaign, &Settings::default(), &|what| steps.at(what))?;
    let mut report = report(&outcome);
    report.remarks.append(&mut notes);
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
