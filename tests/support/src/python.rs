//! A Python with libraries that the project itself does not use: other people's, to test against.

use std::env;
use std::ffi::OsString;
use std::path::Path;
use std::process::Command;

/// Which Python is wanted.
#[derive(Clone, Copy, Debug)]
pub struct Python {
    /// Environment variable that names one which has all of it, in place of an own one.
    pub variable: &'static str,
    /// Name of the folder of the own one.
    pub folder: &'static str,
    /// What pip installs into it.
    pub packages: &'static [&'static str],
    /// What it must be able to import, as Python writes it.
    pub imports: &'static str,
}

impl Python {
    /// The Python that is named, or the own one, beside the folder that cargo gives integration tests
    /// for their files (`CARGO_TARGET_TMPDIR`); `None`, and a word about it, where none can be had.
    #[track_caller]
    pub fn find(&self, temporary: &str) -> Option<OsString> {
        if let Some(python) = env::var_os(self.variable) {
            return Some(python);
        }
        let place = Path::new(temporary).with_file_name(self.folder);
        let python = place.join("bin").join("python");
        let import = format!("import {}", self.imports);
        let is_ready = || runs(Command::new(&python).args(["-c", &import]));
        if is_ready() {
            return Some(python.into());
        }
        if !runs(Command::new("python3").args(["-m", "venv"]).arg(&place)) {
            let variable = self.variable;
            super::skip(&format!("python3 with venv is absent; {variable} can name another"));
            return None;
        }
        println!("installing {} into {}", self.packages.join(", "), place.display());
        runs(Command::new(&python).args(["-m", "pip", "install", "--quiet"]).args(self.packages));
        if !is_ready() {
            let packages = self.packages.join(", ");
            super::skip(&format!("pip cannot install {packages}: no package index is reached"));
            return None;
        }
        Some(python.into())
    }
}

fn runs(command: &mut Command) -> bool {
    command.output().is_ok_and(|run| run.status.success())
}
