//! `rrr set-key`: the board's key, at commissioning.

use std::fs::OpenOptions;
use std::io::{Read, Write};
use std::os::unix::fs::OpenOptionsExt;
use std::path::{Path, PathBuf};

use clap::Args;
use firmware::link::{Command, Key};

use super::Failure;
use super::link_choice::{LinkChoice, openness, read_key};

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
    pub link: LinkChoice,
}

/// Runs the command.
///
/// # Errors
/// A file that cannot be read or made, a board that does not answer, or a wrong old key.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut client = arguments.link.connect()?;
    let key = arguments.file.as_deref().map(key_in).transpose()?;
    client.order(Command::SetKey { key })?;
    client.use_key(key);
    println!("link        {}", openness(&client.report()?));
    Ok(())
}

fn key_in(path: &Path) -> Result<Key, Failure> {
    if !path.exists() {
        make(path).map_err(|error| {
            let message = format!("{}: no key can be made: {error}", path.display());
            Failure::new(message, "name a file in a directory that you may write to")
        })?;
        println!("{}: a new key, readable by you alone; keep a copy", path.display());
    }
    read_key(path)
}

fn make(path: &Path) -> std::io::Result<()> {
    let mut key: Key = [0; 32];
    std::fs::File::open("/dev/urandom")?.read_exact(&mut key)?;
    let digits: String = key.iter().map(|byte| format!("{byte:02x}")).collect();
    let mut file = OpenOptions::new().write(true).create_new(true).mode(0o600).open(path)?;
    writeln!(file, "{digits}")
}
