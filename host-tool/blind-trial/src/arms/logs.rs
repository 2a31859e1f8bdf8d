//! The directory of a case, as `rrr diagnose` takes it.

use std::path::Path;

use files::{ArmFile, Dataset, Entry, Experiment, Problem};
use recordings::ArmCampaign;

use crate::error::TrialError;
use crate::logs::MODEL_NAME;

/// Writes logs, their list and the model; nothing else.
///
/// # Errors
/// The directory cannot be written.
pub fn write(campaign: &ArmCampaign, directory: &Path) -> Result<(), TrialError> {
    std::fs::create_dir_all(directory).map_err(|e| Problem::Unwritable(e).in_file(directory))?;
    let mut entries = Vec::new();
    for recording in &campaign.recordings {
        recording.log.write(directory.join(&recording.file), &campaign.arm)?;
        let (file, role, experiment) = (recording.file.clone(), recording.role, Experiment::Task);
        entries.push(Entry { file, experiment, role, joint: None });
    }
    let dataset =
        Dataset { directory: directory.to_owned(), encoder_counts_per_rev: None, entries };
    dataset.write(directory)?;
    Ok(campaign.arm.write(directory.join(MODEL_NAME))?)
}

/// All that the diagnosis gets to see.
///
/// # Errors
/// Files that cannot be used.
pub fn read(directory: &Path) -> Result<ArmCampaign, TrialError> {
    let arm = ArmFile::read(directory.join(MODEL_NAME))?;
    Ok(ArmCampaign::read(&Dataset::read(directory)?, arm)?)
}
