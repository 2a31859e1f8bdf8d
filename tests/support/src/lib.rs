//! Data and images that tests need, and what tests do without them.
//!
//! A test that misses something says `skipped: TEST, because PATH is absent` and returns.
//! With [`REQUIRE_VARIABLE`] set to 1, as in continuous integration, it fails instead.

mod arm;
mod python;

use std::env;
use std::fs::OpenOptions;
use std::io::Write;
use std::panic::Location;
use std::path::{Path, PathBuf};

pub use arm::PIVOT;
pub use python::Python;

/// Set to 1 where nothing may be missing.
pub const REQUIRE_VARIABLE: &str = "RRR_REQUIRE_DATA";

/// Holds the path of the firmware's image for QEMU; `cargo xtask test` sets it.
pub const IMAGE_VARIABLE: &str = "RRR_QEMU_FIRMWARE";

/// Holds the path of a list to which each skipped test adds a line; `cargo xtask test` sets it.
pub const SKIPPED_VARIABLE: &str = "RRR_SKIPPED_TESTS";

/// A file or folder of the collected data, `shared/data` beside the working tree; `None`
/// where it is absent and need not be there.
///
/// # Panics
/// It is absent and must be there.
#[track_caller]
pub fn data(name: &str) -> Option<PathBuf> {
    let tree = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).expect("tests/support");
    let path = tree.with_file_name("shared").join("data").join(name);
    present(path, is_set(REQUIRE_VARIABLE))
}

/// The firmware's image for QEMU; `None` where none is named and none need be there.
///
/// # Panics
/// The image named is absent, or none is named and one must be there.
#[track_caller]
pub fn image() -> Option<PathBuf> {
    match env::var_os(IMAGE_VARIABLE) {
        Some(path) => present(path.into(), true),
        None => present(format!("${IMAGE_VARIABLE}").into(), is_set(REQUIRE_VARIABLE)),
    }
}

fn is_set(variable: &str) -> bool {
    env::var_os(variable).is_some_and(|value| value == "1")
}

#[track_caller]
fn present(path: PathBuf, is_required: bool) -> Option<PathBuf> {
    if is_there(&path, is_required) {
        return Some(path);
    }
    skip(&format!("{} is absent", path.display()));
    None
}

/// Says that the test is left out, and why.
#[track_caller]
pub fn skip(why: &str) {
    tell(&format!("skipped: {}, because {why}\n", test_name()));
}

fn is_there(path: &Path, is_required: bool) -> bool {
    let is_there = path.exists();
    assert!(is_there || !is_required, "{} is absent, but must be there", path.display());
    is_there
}

/// The test that runs in this thread, or else the line that asks.
#[track_caller]
fn test_name() -> String {
    match std::thread::current().name() {
        Some(name) if name != "main" => name.to_owned(),
        _ => Location::caller().to_string(),
    }
}

/// Writes past the test harness, which shows only the prints of tests that fail.
fn tell(line: &str) {
    // Where nobody can be told, the test still need not fail.
    let _ = std::io::stderr().write_all(line.as_bytes());
    if let Some(list) = env::var_os(SKIPPED_VARIABLE) {
        let list = OpenOptions::new().append(true).create(true).open(list);
        let _ = list.and_then(|mut list| list.write_all(line.as_bytes()));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_need_not_be_there_may_be_absent() {
        let there = tempfile::tempdir().unwrap();
        assert!(is_there(there.path(), false) && is_there(there.path(), true));
        assert!(!is_there(&there.path().join("log.csv"), false));
    }

    #[test]
    #[should_panic(expected = "nowhere/log.csv is absent, but must be there")]
    fn what_must_be_there_is_named_where_it_is_absent() {
        is_there(Path::new("nowhere/log.csv"), true);
    }

    #[test]
    fn a_test_is_named() {
        assert!(test_name().contains("a_test_is_named"), "{}", test_name());
    }
}
