//! `rrr validate`: how well a model reconstructs motion that it was not fitted to.

use std::path::PathBuf;

use clap::Args;

use crate::failure::Failure;
use crate::output_files::create_directory;
use crate::terminal::progress::Steps;
use files::mapping::told;
use files::{Dataset, RobotFile, Role};
use identification::procedure::HeldOutLog;
use recordings::Trace;
use report::validation_page::{HEADER, rows, validation_page};

/// Arguments of `rrr validate`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The data set: a directory with dataset.toml and its logs.
    #[arg(value_name = "DATASET")]
    pub dataset: PathBuf,
    /// The model to judge.
    #[arg(long, value_name = "MODEL.toml")]
    pub model: PathBuf,
    /// Directory for validation.html.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
}

/// Runs the command.
///
/// # Errors
/// Files that cannot be used, or no log with role "holdout".
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let robot = RobotFile::read(&arguments.model)?.robot()?;
    let dataset = Dataset::read(&arguments.dataset)?;
    let steps = Steps::new();
    steps.at("reading the logs");
    let recordings = dataset.recordings_of(Role::Holdout)?;
    if recordings.is_empty() {
        let list = arguments.dataset.join("dataset.toml");
        let message = format!("{}: no log has role \"holdout\"", list.display());
        return Err(Failure::new(message, "give one log that role; the model is judged on it"));
    }
    let of_logs = recordings.iter().map(|r| (r.entry.file.as_str(), r.notes.as_slice()));
    let notes = told(of_logs);
    steps.at("reconstructing");
    let held: Result<Vec<HeldOutLog>, _> = recordings
        .into_iter()
        .map(|recording| HeldOutLog::of(&Trace::of(recording), &robot))
        .collect();
    let held = held?;
    create_directory(&arguments.out)?;
    let page = arguments.out.join("validation.html");
    validation_page(&held).write(&page)?;
    steps.finish();
    println!("{}", HEADER.map(|name| format!("{name:>18}")).join(""));
    for row in rows(&held) {
        println!("{}", row.iter().map(|cell| format!("{cell:>18}")).collect::<String>());
    }
    notes.iter().for_each(|note| println!("  note: {note}"));
    println!("\nFigures: {}", page.display());
    Ok(())
}
