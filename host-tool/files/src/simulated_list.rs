//! Lists of simulated logs, which may take the place of one another, but never of recorded ones.

use std::io::Write;
use std::path::Path;

use toml::Spanned;
use toml::de::DeValue;

use super::dataset::{Dataset, LIST_NAME};
use super::error::{FileError, Problem};
use super::replace::replace_file;
use super::toml_source::TomlSource;

/// The key of a `[[log]]` that was simulated.
const MARK: &str = "simulated";

impl Dataset {
    /// Writes the list with every log marked as simulated, whole or not at all.
    ///
    /// # Errors
    /// As of [`Dataset::write`].
    pub fn write_simulated(&self, directory: impl AsRef<Path>) -> Result<(), FileError> {
        let path = directory.as_ref().join(LIST_NAME);
        let text = self.text(&path)?.replace("\nrole = ", &format!("\n{MARK} = true\nrole = "));
        replace_file(&path, |out| out.write_all(text.as_bytes()).map_err(Problem::Unwritable))
    }

    /// Refuses a directory in which simulated logs of these names would take the place of others.
    ///
    /// # Errors
    /// Its list has a log that is not marked as simulated, or one of the files is there without a
    /// list; or a list that cannot be used.
    pub fn check_room(directory: &Path, files: &[String]) -> Result<(), FileError> {
        let path = directory.join(LIST_NAME);
        if path.exists() {
            return match recorded(&path)? {
                None => Ok(()),
                Some(what) => Err(Problem::RecordedLogs(what).in_file(&path)),
            };
        }
        match files.iter().map(|file| directory.join(file)).find(|path| path.exists()) {
            None => Ok(()),
            Some(path) => {
                let what = "is there already, and in no list of simulated logs".to_owned();
                Err(Problem::RecordedLogs(what).in_file(&path))
            }
        }
    }
}

/// Says which logs of a list are not marked as simulated, if any is not.
fn recorded(path: &Path) -> Result<Option<String>, FileError> {
    let source = TomlSource::read(path)?;
    let document = source.document()?;
    let logs = match document.get_ref().get("log").map(Spanned::get_ref) {
        Some(DeValue::Array(logs)) => logs.iter().filter_map(|log| log.get_ref().as_table()),
        _ => return Ok(Some("is no list of simulated logs".to_owned())),
    };
    let is_simulated = |value: &Spanned<DeValue>| value.get_ref().as_bool() == Some(true);
    let recorded = logs.filter(|log| !log.get(MARK).is_some_and(is_simulated));
    let names: Vec<&str> = recorded.filter_map(|log| log.get("file")?.get_ref().as_str()).collect();
    Ok(match names.as_slice() {
        [] => None,
        [one] => Some(format!("lists {one}, which was not simulated")),
        [one, rest @ ..] => {
            Some(format!("lists {one} and {} more that were not simulated", rest.len()))
        }
    })
}
