//! What causes the gap between the logs in a folder and the model beside them, in a sentence:
//! `cargo run --release --example diagnose -- FOLDER`.
//!
//! The folder holds dataset.toml, its logs, and model.toml.

use std::error::Error;
use std::path::Path;

use diagnosis::{Criteria, diagnose, sentence};
use files::{Dataset, RobotFile};
use recordings::Campaign;
use rig::effects::Catalogue;

/// Diagnoses a folder.
pub fn diagnosed(folder: &Path) -> Result<String, Box<dyn Error>> {
    let model = RobotFile::read(folder.join("model.toml"))?;
    let campaign = Campaign::read(&Dataset::read(folder)?, model)?;
    let diagnosis = diagnose(&campaign, &Catalogue::standard(), &Criteria::default(), &|step| {
        eprintln!("{step}")
    })?;
    Ok(sentence(&diagnosis))
}

#[allow(dead_code)] // The test calls the function.
fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).ok_or("name a folder")?;
    println!("{}", diagnosed(Path::new(&folder))?);
    Ok(())
}
