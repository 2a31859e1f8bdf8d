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

    /// Where a model goes: one that no robot can have beside its place, `model.impossible.toml`.
    pub fn model_path(&self, possible: bool) -> PathBuf {
        match possible {
            true => self.out.clone(),
            false => self.out.with_extension("impossible.toml"),
        }
    }

    /// Ends with a status of its own where the model has gone elsewhere; `remarks` say why.
    ///
    /// # Errors
    /// It has.
    pub fn passed(&self, out: &Path, remarks: &[String]) -> Result<(), Failure> {
        if *out == self.out {
            return Ok(());
        }
        let why = remarks.iter().find(|remark| remark.starts_with("no robot")).cloned();
        let message = format!(
            "{}; {} is not written, the model is in {}",
            why.unwrap_or_else(|| "no robot has these parameters".to_owned()),
            self.out.display(),
            out.display()
        );
        let hint = "look at robot.toml (torque constants, order and signs of joints) and at the notes; \
                    record a richer excitation";
        Err(Failure::not_passed(message, hint))
    }

    /// Writes `identification.json`.
    pub fn write_summary(&self, summary: &impl serde::Serialize) -> Result<(), Failure> {
        let path = self.beside("identification.json")?;
        write_text(&json(summary, &path)?, &path)
    }
}
