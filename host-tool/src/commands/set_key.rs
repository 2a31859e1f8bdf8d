//! `rrr set-key`: the board's key, at commissioning.

use std::path::{Path, PathBuf};

use clap::Args;
use firmware::link::{Command, Key, Refusal};
use serde_json::json;

use crate::failure::Failure;
use crate::options::board::{BoardOptions, access};
use crate::options::key_file::{NewKey, read_key};
use crate::terminal::answer::answer;
use crate::terminal::output::print_line;
use link::{Client, LinkError};

/// Arguments of `rrr set-key`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The key's file; made, with a new key, where it does not exist. The key itself goes
    /// over the line: do this at the rig.
    #[arg(value_name = "FILE", required_unless_present = "remove")]
    pub file: Option<PathBuf>,
    /// Take the key away: the link is open from then on.
    #[arg(long, conflicts_with = "file")]
    pub remove: bool,
    /// Which board; --key is the key that it has now.
    #[command(flatten)]
    pub board: BoardOptions,
}

/// Runs the command.
///
/// # Errors
/// A file that cannot be read or made, a board that does not answer, or a wrong old key.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let file = arguments.file.as_deref();
    // A bad file is reported before a board is looked for.
    let known = file.filter(|path| path.exists()).map(read_key).transpose()?;
    let mut client = arguments.board.connect_to_read()?;
    if client.report()?.has_key {
        client.set_key(arguments.board.key()?);
    }
    match file {
        Some(path) if known.is_none() => give_new(&mut client, path)?,
        _ => give(&mut client, known)?,
    }
    let report = client.report()?;
    print_line(format_args!("link        {}", access(&report)))?;
    answer(&json!({ "needs_key": report.has_key, "key": arguments.file }))
}

/// Gives the board a key, or takes its key away.
fn give(client: &mut Client, key: Option<Key>) -> Result<(), LinkError> {
    client.execute(Command::SetKey { key })?;
    client.set_key(key);
    Ok(())
}

/// Gives the board a new key, which is in the file once the board has it.
fn give_new(client: &mut Client, path: &Path) -> Result<(), Failure> {
    let new = NewKey::make(path)?;
    let asked_again = client.counters().retries;
    if let Err(error) = give(client, Some(new.key)) {
        let once = client.counters().retries == asked_again;
        return Err(if once && is_untouched(&error) {
            error.into()
        } else {
            uncertain(&error, new)
        });
    }
    new.rename()?;
    print_line(format_args!("{}: a new key, readable by you alone; keep a copy", path.display()))
}

/// Whether the board surely has the key that it had, if it was asked only once.
///
/// Asked again, it may have taken the key first, and refuse for another reason afterwards.
fn is_untouched(error: &LinkError) -> bool {
    match error {
        LinkError::Refused { why, .. } => !matches!(**why, Refusal::Store(_)),
        _ => false,
    }
}

/// The failure where the board may have the new key; its temporary file is kept.
fn uncertain(error: &LinkError, new: NewKey) -> Failure {
    let (kept, path) = new.keep();
    let message = format!("{error}; the board may have the new key all the same, see {kept}");
    let hint = format!(
        "try `rrr set-key {kept} --key {kept}`: if that works, the board has it, so rename it to \
         {}; if the key is refused, the board has the one that it had",
        path.display()
    );
    Failure::new(message, hint)
}
