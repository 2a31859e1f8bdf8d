//! The target as rustup delivers it.

use std::path::Path;
use std::process::Command;
use std::time::Duration;

use super::target::TARGET;
use crate::command::{capture, say, succeeds_within};

const DOWNLOAD_LIMIT: Duration = Duration::from_secs(60);

/// Whether the host's own compiler has a core library for the target.
pub fn has_target() -> bool {
    let query = ["--print", "target-libdir", "--target", TARGET];
    capture(Command::new("rustc").args(query)).is_ok_and(|dir| Path::new(&dir).is_dir())
}

/// Has rustup fetch the target; false where it cannot.
pub fn add_target() -> bool {
    say(format!("adding the target {TARGET} to the Rust toolchain (rustup target add)"));
    let mut command = Command::new("rustup");
    let added =
        succeeds_within(DOWNLOAD_LIMIT, command.args(["target", "add", TARGET])) && has_target();
    if !added {
        say("rustup cannot deliver it here: going on with Debian's packages");
    }
    added
}
