//! A Python with the libraries that others write their logs with.

use std::ffi::OsString;
use std::path::Path;
use std::process::Command;

/// Names a Python that has them, in place of an own one.
const VARIABLE: &str = "RRR_LOGS_PYTHON";
/// What is installed from the package index otherwise.
const PACKAGES: [&str; 3] = ["mcap-ros2-support==0.6.0", "numpy", "pyarrow"];

/// The Python named by [`VARIABLE`], or one of its own below `target/`; `None`, and a word about it,
/// where none can be had.
pub fn with_log_writers() -> Option<OsString> {
    if let Some(python) = std::env::var_os(VARIABLE) {
        return Some(python);
    }
    let place = Path::new(env!("CARGO_TARGET_TMPDIR")).with_file_name("logs-python");
    let python = place.join("bin").join("python");
    let is_ready = || runs(Command::new(&python).args(["-c", "import mcap_ros2, numpy, pyarrow"]));
    if !is_ready() {
        if !runs(Command::new("python3").args(["-m", "venv"]).arg(&place)) {
            test_support::skip("python3 with venv is absent; RRR_LOGS_PYTHON can name another");
            return None;
        }
        println!("installing {} into {}", PACKAGES.join(", "), place.display());
        runs(Command::new(&python).args(["-m", "pip", "install", "--quiet"]).args(PACKAGES));
        if !is_ready() {
            test_support::skip("pip cannot install mcap-ros2-support: no package index is reached");
            return None;
        }
    }
    Some(python.into())
}

fn runs(command: &mut Command) -> bool {
    command.output().is_ok_and(|run| run.status.success())
}
