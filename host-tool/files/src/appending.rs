//! A data set that grows: a `[[log]]` more in `dataset.toml`, the rest of the text as it was.

use std::io::Write;
use std::path::Path;

use super::dataset::{Dataset, Entry, LIST_NAME};
use super::error::{FileError, Problem};
use super::replace::replace_file;
use super::toml_source::{FORMAT, TomlSource};

impl Dataset {
    /// Adds a log in encoder counts to the list in a directory that is there, whole or not at
    /// all. Whatever the list holds stays byte for byte, comments and notes too; where
    /// there is no list, there is one now.
    ///
    /// # Errors
    /// A list that cannot be used, that has other counts per turn, or cannot be written.
    pub fn append(directory: &Path, entry: &Entry, counts_per_rev: f64) -> Result<(), FileError> {
        let text = Self::appended(directory, entry, counts_per_rev)?;
        let path = directory.join(LIST_NAME);
        replace_file(&path, |out| out.write_all(text.as_bytes()).map_err(Problem::Unwritable))
    }

    /// The list's text with that log: what [`Dataset::append`] would write.
    ///
    /// # Errors
    /// As of [`Dataset::append`], but for the writing.
    pub fn appended(
        directory: &Path,
        entry: &Entry,
        counts_per_rev: f64,
    ) -> Result<String, FileError> {
        let path = directory.join(LIST_NAME);
        let (mut text, mut entries) = match path.exists() {
            true => with_counts(directory, &path, counts_per_rev)?,
            false => (format!("format = {FORMAT}\n{}", counts_line(counts_per_rev)), Vec::new()),
        };
        let table = toml::to_string(entry).map_err(|e| Problem::Toml(e.to_string()));
        let table = table.map_err(|problem| problem.in_file(&path))?;
        end_line(&mut text);
        text += &format!("\n[[log]]\n{table}");
        entries.push(entry.clone());
        match Self::parse(directory, text.clone().into_bytes()) {
            Ok(list) if list.entries == entries => Ok(text),
            _ => Err(Problem::Toml("its logs are not [[log]] tables".to_owned()).in_file(&path)),
        }
    }
}

/// The text of a list that is there, with the counts per turn, and its logs.
fn with_counts(
    directory: &Path,
    path: &Path,
    counts_per_rev: f64,
) -> Result<(String, Vec<Entry>), FileError> {
    let source = TomlSource::read(path)?;
    let mut text = source.text().to_owned();
    let list = Dataset::parse(directory, text.clone().into_bytes())?;
    match list.encoder_counts_per_rev {
        Some(there) if there != counts_per_rev => {
            let what =
                format!("encoder_counts_per_rev is {there}, but the board has {counts_per_rev}");
            return Err(source.problem_in(
                Problem::Contradiction(what),
                "encoder_counts_per_rev",
                None,
                "",
            ));
        }
        Some(_) => {}
        None => {
            end_line(&mut text);
            let place = source.line_end_of_format().min(text.len());
            text.insert_str(place, &counts_line(counts_per_rev));
        }
    }
    Ok((text, list.entries))
}

fn counts_line(counts_per_rev: f64) -> String {
    format!("encoder_counts_per_rev = {counts_per_rev:?}\n").replace(".0\n", "\n")
}

fn end_line(text: &mut String) {
    if !text.ends_with('\n') {
        text.push('\n');
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Experiment, Role};

    const COUNTS: f64 = 655_360.0;

    fn entry() -> Entry {
        Entry {
            file: "slow-2.csv.gz".to_owned(),
            experiment: Experiment::Slow,
            role: Role::Train,
            joint: None,
        }
    }

    fn appended_to(text: &str) -> Result<String, String> {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join(LIST_NAME);
        std::fs::write(&path, text).unwrap();
        let result = Dataset::append(directory.path(), &entry(), COUNTS);
        let found = std::fs::read_to_string(&path).unwrap();
        match result {
            Ok(()) => Ok(found),
            Err(error) => {
                assert_eq!(found, text, "nothing has changed");
                Err(error.to_string())
            }
        }
    }

    const ADDED: &str =
        "\n[[log]]\nfile = \"slow-2.csv.gz\"\nexperiment = \"slow\"\nrole = \"train\"\n";

    #[test]
    fn what_was_there_stays_byte_for_byte() {
        let there = "# Rig 3, after the belt was changed\r\nformat=1   # one\n\
            encoder_counts_per_rev = 655_360\nnotes = { name = 'left', year = 2026 }\n\n\
            [[log]] # by hand\nfile = \"a.csv\"\nexperiment = \"belt-test\"\nrole = \"train\"\n\
            note = \"joint 2 squeaks\"\n\n[note]\nwho = [ 'A', 'B' ]";
        assert_eq!(appended_to(there).unwrap(), format!("{there}\n{ADDED}"));
    }

    #[test]
    fn counts_per_turn_that_are_missing_follow_the_format() {
        let rest = "[[log]]\nfile = \"a.csv\"\nexperiment = \"task\"\nrole = \"holdout\"\n";
        let text = appended_to(&format!("# radians\nformat = 1 # one\n{rest}")).unwrap();
        let counts = "encoder_counts_per_rev = 655360\n";
        assert_eq!(text, format!("# radians\nformat = 1 # one\n{counts}{rest}{ADDED}"));
    }

    #[test]
    fn a_list_that_cannot_take_the_log_is_refused_and_stays() {
        let log = "file = \"a.csv\", experiment = \"task\", role = \"train\"";
        let inline = format!("format = 1\nlog = [{{ {log} }}]\n");
        assert!(appended_to(&inline).unwrap_err().contains("are not [[log]] tables"));
        let other = "format = 1\nencoder_counts_per_rev = 4096\n[[log]]\nfile = \"a.csv\"\n\
            experiment = \"task\"\nrole = \"train\"\n";
        let message = appended_to(other).unwrap_err();
        assert!(message.contains("line 2: encoder_counts_per_rev is 4096"), "{message}");
    }

    #[test]
    fn where_there_is_no_list_there_is_one_now() {
        let directory = tempfile::tempdir().unwrap();
        Dataset::append(directory.path(), &entry(), COUNTS).unwrap();
        let text = std::fs::read_to_string(directory.path().join(LIST_NAME)).unwrap();
        assert_eq!(text, format!("format = 1\nencoder_counts_per_rev = 655360\n{ADDED}"));
    }
}
