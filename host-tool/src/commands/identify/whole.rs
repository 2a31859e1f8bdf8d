//! Arguments of the whole procedure, and what it writes beside the model.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::failure::Failure;
use crate::output_files::{create_directory, json, write_text};

/// Arguments of the whole procedure.
#[derive(Debug, Args)]
pub struct Whole {
    /// The data set: a directory with dataset.toml and its logs.
    #[arg(value_name = "DATASET", required = true)]
    pub dataset: PathBuf,
    /// The manufacturer's data.
    #[arg(long, value_name = "ROBOT.toml", required = true)]
    pub robot: PathBuf,
    /// Where the model goes; identification.json goes beside it, and of the three-joint robot or
    /// one joint identification.html.
    #[arg(long, value_name = "MODEL.toml", required = true)]
    pub out: PathBuf,
}

impl Whole {
    /// A file beside the model, whose directory is there afterwards.
    pub fn beside(&self, name: &str) -> Result<PathBuf, Failure> {
        let directory = self.out.parent().filter(|parent| !parent.as_os_str().is_empty());
        let directory = directory.unwrap_or(Path::new("."));
        create_directory(directory)?;
        Ok(directory.join(name))
    }

    /// Writes `identification.json`.
    pub fn write_summary(&self, summary: &impl serde::Serialize) -> Result<(), Failure> {
        let path = self.beside("identification.json")?;
        write_text(&json(summary, &path)?, &path)
    }
}
