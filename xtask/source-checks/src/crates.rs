//! The crates of a workspace, as cargo knows them.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};
use serde_json::Value;

/// One crate: a library, a program, or a file of tests, benchmarks or examples.
#[derive(Clone, Debug)]
pub struct Crate {
    /// The package's directory.
    pub package: PathBuf,
    /// The file that the crate begins with.
    pub root: PathBuf,
    /// The name by which other crates import it; none where it is no library.
    pub library: Option<String>,
    /// Whether it is a file of tests, benchmarks or examples.
    pub is_test: bool,
}

/// Every crate of the workspace in this directory.
pub fn of_workspace(directory: &Path) -> Result<Vec<Crate>> {
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.args(["metadata", "--no-deps", "--offline", "--format-version", "1"]);
    let output = cargo.current_dir(directory).output().context("cannot start cargo")?;
    if !output.status.success() {
        bail!("cargo metadata failed: {}", String::from_utf8_lossy(&output.stderr).trim());
    }
    let metadata: Value = serde_json::from_slice(&output.stdout)?;
    let packages = metadata["packages"].as_array().context("cargo tells of no packages")?;
    Ok(packages.iter().flat_map(of_package).collect())
}

fn of_package(package: &Value) -> Vec<Crate> {
    let manifest = Path::new(text(&package["manifest_path"]));
    let directory = manifest.parent().unwrap_or(manifest);
    let targets = package["targets"].as_array().into_iter().flatten();
    targets.map(|target| of_target(target, directory)).collect()
}

fn of_target(target: &Value, package: &Path) -> Crate {
    let is_kind = |kind: &str| target["kind"].as_array().is_some_and(|k| k.contains(&kind.into()));
    Crate {
        package: package.to_owned(),
        root: text(&target["src_path"]).into(),
        library: is_kind("lib").then(|| text(&target["name"]).replace('-', "_")),
        is_test: ["test", "bench", "example"].into_iter().any(is_kind),
    }
}

fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}
