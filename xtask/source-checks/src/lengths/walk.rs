//! The files of a directory that are not tests.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

use super::measure::Measured;

/// The directories that hold no code, or tests.
const APART: [&str; 3] = ["target", "tests", "benches"];

/// Every file of Rust, with paths from the directory; without tests and benchmarks.
pub fn measured(directory: &Path) -> Result<Vec<Measured>> {
    let (mut files, mut of_tests) = (Vec::new(), BTreeSet::new());
    walk(directory, Path::new(""), &mut |path, package| {
        let (file, tests) = Measured::read(path, package)?;
        of_tests.extend(tests);
        files.push(file);
        Ok(())
    })?;
    files.retain(|file| !file.path.ancestors().any(|path| of_tests.contains(path)));
    for file in &mut files {
        file.path = file.path.strip_prefix(directory)?.to_owned();
    }
    Ok(files)
}

/// Calls `each` with every file and the directory of its package.
fn walk(
    directory: &Path,
    package: &Path,
    each: &mut impl FnMut(&Path, &Path) -> Result<()>,
) -> Result<()> {
    let entries = fs::read_dir(directory)
        .with_context(|| format!("cannot read {}", directory.display()))?
        .map(|entry| Ok(entry?.path()));
    let mut entries = entries.collect::<Result<Vec<PathBuf>>>()?;
    entries.sort_unstable();
    for path in entries {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if path.is_dir() && !name.starts_with('.') && !APART.contains(&name.as_str()) {
            let inner = package.join(&name);
            let is_package = path.join("Cargo.toml").is_file();
            walk(&path, if is_package { &inner } else { package }, each)?;
        } else if name.ends_with(".rs") {
            each(&path, package)?;
        }
    }
    Ok(())
}
