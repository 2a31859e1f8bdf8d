//! What commands write beside models and logs.

use std::io::Write as _;
use std::path::Path;

use crate::failure::Failure;
use files::Problem;
use files::replace::replace_file;

/// Makes a directory for what a command writes, and those above it.
///
/// # Errors
/// It cannot be made.
pub fn create_directory(directory: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(directory).map_err(|error| {
        let message = format!("{}: cannot be made a directory: {error}", directory.display());
        Failure::new(message, "give another --out")
    })
}

/// Writes a text file, whole or not at all.
///
/// # Errors
/// The file cannot be written.
pub fn write_text(text: &str, path: &Path) -> Result<(), Failure> {
    write_bytes(text.as_bytes(), path)
}

/// Writes a file of bytes, whole or not at all.
///
/// # Errors
/// The file cannot be written.
pub fn write_bytes(bytes: &[u8], path: &Path) -> Result<(), Failure> {
    replace_file(path, |file| file.write_all(bytes).map_err(Problem::Unwritable))?;
    Ok(())
}

/// A structure as JSON, for a file of this name.
///
/// # Errors
/// A value that JSON cannot hold.
pub fn json(value: &impl serde::Serialize, path: &Path) -> Result<String, Failure> {
    serde_json::to_string_pretty(value)
        .map_err(|error| Failure::new(format!("{}: {error}", path.display()), ""))
}
