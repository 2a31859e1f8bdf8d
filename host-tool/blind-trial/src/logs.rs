//! The directory of a case, as `rrr diagnose` takes it.

use std::path::{Path, PathBuf};

use super::case::{Case, Recorded};
use super::error::TrialError;
use files::{Dataset, FileError, Problem, RobotFile};
use recordings::Campaign;

/// The model's file in a case's directory.
pub const MODEL_NAME: &str = "model.toml";

/// Where the logs of a case lie.
pub fn directory(out: &Path, number: u32) -> PathBuf {
    out.join(format!("case-{number:03}"))
}

/// Records a case and writes its logs, their list and the nominal model; nothing else.
///
/// # Errors
/// The board refuses the model, or the directory cannot be written.
pub fn write(case: &Case, directory: &Path) -> Result<(), TrialError> {
    let counts_per_turn = f64::from(case.rig().encoder_counts_per_turn);
    write_recorded(&case.record()?, counts_per_turn, directory)?;
    model_file(case).write(directory.join(MODEL_NAME))?;
    Ok(())
}

/// Writes logs and their list.
///
/// # Errors
/// The directory cannot be written.
pub(crate) fn write_recorded(
    recorded: &[Recorded],
    encoder_counts_per_turn: f64,
    directory: &Path,
) -> Result<(), TrialError> {
    make(directory)?;
    for Recorded { plan, log } in recorded {
        log.write(directory.join(plan.entry("csv.gz").file))?;
    }
    let dataset = Dataset {
        directory: directory.to_owned(),
        encoder_counts_per_rev: Some(encoder_counts_per_turn),
        entries: recorded.iter().map(|recorded| recorded.plan.entry("csv.gz")).collect(),
    };
    Ok(dataset.write(directory)?)
}

fn model_file(case: &Case) -> RobotFile {
    let rig = case.rig();
    let mut file = RobotFile::from_robot(&case.nominal);
    file.robot.encoder_counts_per_rev = Some(f64::from(rig.encoder_counts_per_turn));
    file.robot.sample_period_s = Some(rig.sample_period_s);
    file.robot.command_limit_v = Some(rig.command_limit_v);
    file.robot.command_bits = Some(16);
    file
}

/// All that the diagnosis gets to see.
///
/// # Errors
/// Files that cannot be used.
pub fn read(directory: &Path) -> Result<Campaign, TrialError> {
    let file = RobotFile::read(directory.join(MODEL_NAME))?;
    Ok(Campaign::read(&Dataset::read(directory)?, file)?)
}

/// Takes a case's logs away.
///
/// # Errors
/// The directory cannot be removed.
pub fn remove(directory: &Path) -> Result<(), TrialError> {
    std::fs::remove_dir_all(directory).map_err(|error| unwritable(error, directory).into())
}

fn make(directory: &Path) -> Result<(), TrialError> {
    std::fs::create_dir_all(directory).map_err(|error| unwritable(error, directory).into())
}

fn unwritable(error: std::io::Error, path: &Path) -> FileError {
    Problem::Unwritable(error).in_file(path)
}
