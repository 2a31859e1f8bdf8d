//! `cargo xtask python`: the wheel of the Python module as others install it, and its tests.

use std::ffi::{OsStr, OsString};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result};
use test_support::Python;

use crate::command::{run as run_command, say};
use crate::workspace;

/// The crate.
pub const PACKAGE: &str = "python-module";

/// What builds the wheel and tests it.
const WANTED: Python = Python {
    variable: "RRR_PYTHON",
    folder: "python-tests",
    packages: &[
        "maturin",
        "numpy",
        "mujoco",
        "pytest",
        "mypy",
        "nbclient",
        "ipykernel",
        "tqdm",
        "ray",
        "pyarrow",
        "fsspec",
        "duckdb",
        // Stores of objects, and servers that stand for them.
        "s3fs",
        "moto[s3]",
        "flask",
        "flask-cors",
        "gcsfs",
        "gcp-storage-emulator",
    ],
    imports: "maturin, numpy, mujoco, pytest, mypy, nbclient, ipykernel, tqdm, ray, pyarrow, \
              fsspec, duckdb, s3fs, moto, flask_cors, gcsfs, gcp_storage_emulator",
};

/// Builds the wheel, installs it into a fresh environment and into that of the tests, and runs
/// these; says so and does nothing where pip finds nothing.
pub fn test() -> Result<()> {
    let Some(python) = interpreter() else { return Ok(()) };
    let target = workspace::target_dir();
    say("building the wheel of the Python module");
    let wheel = wheel(&python, &target)?;
    say(format!("installing {} with numpy into a fresh environment", wheel.display()));
    try_fresh(&python, &wheel, &target.join("python-fresh"))?;
    say("running the tests of the Python module");
    let mut install = pip(&python);
    run_command(install.args(["--force-reinstall", "--no-deps"]).arg(&wheel))?;
    let mut types = tool(&python, "mypy");
    run_command(types.args(["--no-error-summary", "rrr", "tests", "examples", "trials"]))?;
    run_command(tool(&python, "pytest").arg("--quiet"))
}

/// Installs what the tests take, so that they need not wait for it; says so and does nothing where pip finds nothing.
pub fn prepare() {
    interpreter();
}

/// The interpreter that has what builds the wheel and tests it.
fn interpreter() -> Option<OsString> {
    WANTED.find(&workspace::target_dir().join("tmp").display().to_string())
}

/// The wheel, built anew.
fn wheel(python: &OsStr, target: &Path) -> Result<PathBuf> {
    let folder = target.join("wheels");
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    let mut build = tool(python, "maturin");
    build.args(["build", "--quiet", "--release", "--out"]).arg(&folder);
    run_command(&mut build)?;
    let first = fs::read_dir(&folder)?.next().context("maturin left no wheel")?;
    Ok(first?.path())
}

/// That the wheel is all that a user needs.
fn try_fresh(python: &OsStr, wheel: &Path, place: &Path) -> Result<()> {
    run_command(Command::new(python).args(["-m", "venv", "--clear"]).arg(place))?;
    let fresh: OsString = place.join("bin").join("python").into();
    run_command(pip(&fresh).arg(wheel))?;
    let mut import = Command::new(&fresh);
    run_command(import.args(["-c", "import rrr; assert rrr.default_criteria()"]).current_dir(place))
}

fn pip(python: &OsStr) -> Command {
    let mut command = Command::new(python);
    command.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]);
    command
}

/// A module of Python's, in the folder of the Python module.
fn tool(python: &OsStr, module: &str) -> Command {
    let mut command = Command::new(python);
    // -P: the installed module, not the sources beside.
    command.args(["-P", "-m", module]).current_dir(workspace::root().join("python"));
    command
}
