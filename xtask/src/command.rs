//! Running other programs.

use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};
use std::{env, thread};

use anyhow::{Context, Result, bail};

use crate::workspace;

/// Tells the user, on standard error, what is about to be done.
pub fn say(message: impl Display) {
    eprintln!("xtask: {message}");
}

/// The cargo that runs this task, in the workspace's root.
pub fn cargo(subcommand: &str) -> Command {
    let mut command = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.arg(subcommand).current_dir(workspace::root());
    command
}

/// Runs a program whose output the user sees.
pub fn run(command: &mut Command) -> Result<()> {
    let status = command.status().with_context(|| cannot_start(command))?;
    if !status.success() {
        bail!("`{}` failed ({status})", shown(command));
    }
    Ok(())
}

/// Runs a program, and does something else in the meantime.
pub fn run_beside<T>(command: &mut Command, other: impl FnOnce() -> Result<T>) -> Result<T> {
    thread::scope(|scope| {
        let running = scope.spawn(|| run(command));
        let done = other();
        running.join().expect("running a program does not panic").and(done)
    })
}

/// Runs a program and returns what it printed, with no blanks around it.
pub fn capture(command: &mut Command) -> Result<String> {
    let Output { status, stdout, stderr } =
        command.output().with_context(|| cannot_start(command))?;
    if !status.success() {
        let stderr = String::from_utf8_lossy(&stderr);
        bail!("`{}` failed ({status}): {}", shown(command), stderr.trim());
    }
    Ok(String::from_utf8_lossy(&stdout).trim().to_owned())
}

/// Runs a program without a word; false if it fails or is not done in time.
pub fn succeeds_within(limit: Duration, command: &mut Command) -> bool {
    let silent = command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let Ok(mut child) = silent.spawn() else { return false };
    let deadline = Instant::now() + limit;
    while Instant::now() < deadline {
        match child.try_wait() {
            Ok(None) => thread::sleep(Duration::from_millis(50)),
            Ok(Some(status)) => return status.success(),
            Err(_) => return false,
        }
    }
    // Killing fails only if the program has just ended by itself.
    let _ = child.kill();
    let _ = child.wait();
    false
}

/// The program of this name in the search path.
pub fn find_program(name: &str) -> Option<PathBuf> {
    let directories = env::var_os("PATH")?;
    env::split_paths(&directories).map(|dir| dir.join(name)).find(|path: &PathBuf| is_file(path))
}

fn is_file(path: &Path) -> bool {
    path.metadata().is_ok_and(|metadata| metadata.is_file())
}

fn cannot_start(command: &Command) -> String {
    format!("cannot start `{}`: is it installed?", command.get_program().display())
}

fn shown(command: &Command) -> String {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    words.map(|word| word.to_string_lossy()).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_that_hangs_is_ended() {
        let begin = Instant::now();
        assert!(!succeeds_within(Duration::from_millis(100), Command::new("sleep").arg("60")));
        assert!(begin.elapsed() < Duration::from_secs(10));
    }

    #[test]
    fn a_program_that_fails_or_is_not_there_does_not_succeed() {
        assert!(succeeds_within(Duration::from_secs(10), &mut Command::new("true")));
        assert!(!succeeds_within(Duration::from_secs(10), &mut Command::new("false")));
        assert!(!succeeds_within(Duration::from_secs(10), &mut Command::new("no-such-program")));
    }

    #[test]
    fn what_fails_of_two_is_told() {
        let beside = |program, value: Result<u8>| run_beside(&mut Command::new(program), || value);
        assert_eq!(beside("true", Ok(1)).unwrap(), 1);
        assert!(beside("false", Ok(1)).is_err());
        assert!(beside("true", Err(anyhow::anyhow!("no"))).is_err());
    }

    #[test]
    fn a_failure_shows_the_command_and_its_error() {
        let error = capture(Command::new("sh").args(["-c", "echo why >&2; exit 3"]));
        let text = error.expect_err("it exits with 3").to_string();
        assert!(text.contains("sh -c") && text.ends_with("why"), "{text}");
    }
}
