//! `rrr` as a new user meets it.

use std::path::Path;
use std::process::{Command, Output};

use assert_cmd::cargo::cargo_bin;
use files::RobotFile;
use model::reference_robot::reference_robot;

/// Runs `rrr` in a directory.
pub fn rrr(directory: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(cargo_bin("rrr"));
    command.current_dir(directory).args(arguments).env_remove("RRR_KEY_FILE").output().unwrap()
}

/// What it says on success.
pub fn said(directory: &Path, arguments: &[&str]) -> String {
    let run = rrr(directory, arguments);
    let error = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "{arguments:?}: {error}");
    String::from_utf8(run.stdout).unwrap()
}

/// What it says on exit status 2.
pub fn refused(directory: &Path, arguments: &[&str]) -> String {
    let run = rrr(directory, arguments);
    let text = String::from_utf8(run.stderr).unwrap();
    assert_eq!(run.status.code(), Some(2), "{arguments:?}: {text}");
    text
}

/// Asserts that a text has all of the parts.
#[track_caller]
pub fn assert_tells(text: &str, parts: &[&str]) {
    parts.iter().for_each(|part| assert!(text.contains(part), "no `{part}` in: {text}"));
}

/// A directory with the reference robot's `model.toml`.
pub fn with_model() -> tempfile::TempDir {
    let directory = tempfile::tempdir().unwrap();
    RobotFile::from_robot(&reference_robot()).write(directory.path().join("model.toml")).unwrap();
    directory
}

/// Writes a file below a directory.
pub fn write(directory: &Path, name: &str, text: &str) {
    let path = directory.join(name);
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(path, text).unwrap();
}
