//! What a command has found, for programs: one JSON object on the standard output where `--json` asks
//! for it, and everything in words on the standard error then.

use std::sync::atomic::{AtomicBool, Ordering};

use serde::Serialize;
use serde_json::json;

use super::json_mode::is_json;
use super::output;
use crate::failure::Failure;

static ANSWERED: AtomicBool = AtomicBool::new(false);
static IS_PART: AtomicBool = AtomicBool::new(false);

/// Whether what follows is a part of another command, which answers for all of them.
pub fn is_part(is_part: bool) {
    IS_PART.store(is_part, Ordering::Relaxed);
}

/// Prints the answer, where JSON is asked for.
///
/// # Errors
/// The standard output does not take it.
pub fn answer(found: &impl Serialize) -> Result<(), Failure> {
    if !is_json() || IS_PART.load(Ordering::Relaxed) {
        return Ok(());
    }
    ANSWERED.store(true, Ordering::Relaxed);
    let text = serde_json::to_string(found)
        .map_err(|error| Failure::new(format!("the answer is no JSON: {error}"), ""))?;
    match output::write(&format!("{text}\n")) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(output::not_written(&error))
        }
        _ => Ok(()),
    }
}

/// Prints a failure, where JSON is asked for and nothing was answered: `error`, `hint`, `status`.
pub fn answer_failure(failure: &Failure) {
    if is_json() && !ANSWERED.load(Ordering::Relaxed) {
        let Failure { message, hint, status } = failure;
        let text = json!({ "error": message, "hint": hint, "status": status });
        // The standard error and the exit status tell it as well.
        let _ = output::write(&format!("{text}\n"));
    }
}
