//! `rrr identify`: the model of an unknown robot from its recorded experiments.

use std::io::Write as _;
use std::path::{Path, PathBuf};

use clap::Args;

use super::{Failure, create_directory};
use crate::files::replace::replace_file;
use crate::files::{Dataset, Problem, RobotFile};
use crate::identification::procedure::{self, Identified, model_file};
use crate::identification::{Campaign, StepError};
use crate::progress::Steps;
use crate::report::identification_page::identification_page;
use crate::report::identification_summary::Summary;

/// Arguments of `rrr identify`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The data set: a directory with dataset.toml and its logs.
    #[arg(value_name = "DATASET")]
    pub dataset: PathBuf,
    /// What the manufacturer tells.
    #[arg(long, value_name = "ROBOT.toml")]
    pub robot: PathBuf,
    /// Where the model goes; identification.json and identification.html go beside it.
    #[arg(long, value_name = "MODEL.toml")]
    pub out: PathBuf,
}

/// Runs the command.
///
/// # Errors
/// Files that cannot be used, or experiments that do not determine a model.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let steps = Steps::new();
    steps.at("reading the logs");
    let robot_file = RobotFile::read(&arguments.robot)?;
    let campaign = Campaign::read(&Dataset::read(&arguments.dataset)?, robot_file)?;
    let identified = procedure::identify(&campaign, &|step| steps.at(step))?;
    steps.at("writing the report");
    let directory = arguments.out.parent().filter(|p| !p.as_os_str().is_empty());
    let directory = directory.unwrap_or(Path::new("."));
    create_directory(directory)?;
    model_file(&identified, &campaign.robot_file).write(&arguments.out)?;
    write_summary(&identified, &directory.join("identification.json"))?;
    let page = directory.join("identification.html");
    identification_page(&campaign, &identified).write(&page)?;
    steps.finish();
    print_table(&identified);
    println!("\nModel: {}\nFigures: {}", arguments.out.display(), page.display());
    Ok(())
}

fn write_summary(identified: &Identified, path: &Path) -> Result<(), Failure> {
    let summary = Summary::of(identified);
    let text = serde_json::to_string_pretty(&summary).unwrap_or_default();
    replace_file(path, |file| file.write_all(text.as_bytes()).map_err(Problem::Unwritable))?;
    Ok(())
}

fn print_table(identified: &Identified) {
    println!("What the model leaves of the command on the logs held out:\n");
    println!("  log                          joint 1            joint 2            joint 3");
    for held in &identified.held {
        let shares: Vec<String> = held
            .residuals()
            .iter()
            .map(|r| format!("{:5.1} mV ({:4.2} %)", 1e3 * r.rms_v, 100.0 * r.share))
            .collect();
        println!("  {:26} {}", held.file, shares.join("  "));
    }
    for remark in &identified.missing {
        println!("  note: {remark}");
    }
}

impl From<StepError> for Failure {
    fn from(error: StepError) -> Self {
        let hint = match &error {
            StepError::NoLog { .. } => "list the log in dataset.toml with role \"train\"",
            StepError::Unusable { .. } => "look at the log, and record it again if need be",
            StepError::Numerical { .. } => "look at the logs: the motion may not excite it",
        };
        Self::new(error.to_string(), hint)
    }
}
