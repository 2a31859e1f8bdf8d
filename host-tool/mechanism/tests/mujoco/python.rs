//! A Python that knows MuJoCo.

use std::ffi::OsString;
use std::path::Path;
use std::process::Command;

/// Names a Python that has `mujoco` and `numpy`, in place of an own one.
const VARIABLE: &str = "RRR_MUJOCO_PYTHON";
/// The version that the figures in docs/mechanisms.md are from.
const PACKAGES: [&str; 2] = ["mujoco==4.0.0", "numpy"];

/// The Python named by [`VARIABLE`], or one of its own below `target/`; `None`, and a word about
/// it, where none can be had.
pub fn with_mujoco() -> Option<OsString> {
    if let Some(python) = std::env::var_os(VARIABLE) {
        return Some(python);
    }
    let place = Path::new(env!("CARGO_TARGET_TMPDIR")).with_file_name("mujoco-python");
    let python = place.join("bin").join("python");
    let has_mujoco = || runs(Command::new(&python).args(["-c", "import mujoco, numpy"]));
    if !has_mujoco() {
        let made = runs(Command::new("python3").args(["-m", "venv"]).arg(&place));
        if !made {
            test_support::skip("python3 with venv is absent; RRR_MUJOCO_PYTHON can name another");
            return None;
        }
        runs(Command::new(&python).args(["-m", "pip", "install", "--quiet"]).args(PACKAGES));
        if !has_mujoco() {
            test_support::skip("pip cannot install mujoco: no package index can be reached");
            return None;
        }
    }
    Some(python.into())
}

fn runs(command: &mut Command) -> bool {
    command.output().is_ok_and(|run| run.status.success())
}
