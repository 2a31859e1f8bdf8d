//! Where things are in the working tree.

use std::env;
use std::path::{Path, PathBuf};

/// The directory of the workspace's `Cargo.toml`.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("xtask is a directory of the workspace")
}

/// Where cargo puts the host's builds.
pub fn target_dir() -> PathBuf {
    match env::var_os("CARGO_TARGET_DIR") {
        Some(dir) => root().join(dir),
        None => root().join("target"),
    }
}

/// Where the firmware is built, apart from the host's crates: it may need another
/// compiler, and a change of compiler invalidates everything in a target directory.
pub fn firmware_target_dir() -> PathBuf {
    target_dir().join("firmware")
}
