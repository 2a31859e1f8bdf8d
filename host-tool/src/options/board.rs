//! Which board a command talks to and with which key.

use std::path::PathBuf;

use clap::Args;
use firmware::link::{Key, Report};

use super::key_file::read_key;
use crate::failure::Failure;
use link::{Address, Client, LinkError};

/// Names the key's file where --key does not.
pub const KEY_VARIABLE: &str = "RRR_KEY_FILE";

/// Where the board is, and the key to it.
#[derive(Clone, Debug, Default, Args)]
pub struct BoardOptions {
    /// The board's line: a serial port or pty, tcp:HOST:PORT, or unix:SOCKET; not needed
    /// where there is just one ST-LINK or one serial port at USB.
    #[arg(long, value_name = "PORT")]
    pub port: Option<String>,
    /// The board's key: a file of 64 hexadecimal digits, as `rrr set-key` makes it; without
    /// the option, the file that RRR_KEY_FILE names.
    #[arg(long, value_name = "FILE")]
    pub key: Option<PathBuf>,
}

impl BoardOptions {
    /// Opens the line and says Hello.
    ///
    /// # Errors
    /// No line, no board, one of another build, or a key file that is none.
    pub fn connect(&self) -> Result<Client, Failure> {
        let key = self.key()?;
        Ok(Client::connect(&self.address()?, key)?)
    }

    /// The same for what needs no key: the file that RRR_KEY_FILE names is not read.
    ///
    /// # Errors
    /// As of [`BoardOptions::connect`], where --key names the file.
    pub fn connect_to_read(&self) -> Result<Client, Failure> {
        self.key.as_deref().map(read_key).transpose()?;
        self.connect_without_key()
    }

    /// The same to stop the arm: no key file keeps one from that.
    ///
    /// # Errors
    /// No line, no board, or one of another build.
    pub fn connect_without_key(&self) -> Result<Client, Failure> {
        Ok(Client::connect(&self.address()?, None)?)
    }

    fn address(&self) -> Result<Address, LinkError> {
        self.port.as_deref().map_or_else(Address::find, |text| Ok(Address::of(text)))
    }

    /// The key, where the user names a file.
    ///
    /// # Errors
    /// The file cannot be read, or holds something else.
    pub fn key(&self) -> Result<Option<Key>, Failure> {
        let named = std::env::var_os(KEY_VARIABLE).filter(|name| !name.is_empty());
        let path = self.key.clone().or(named.map(PathBuf::from));
        path.as_deref().map(read_key).transpose()
    }
}

/// Whether the board keeps its key to itself, in words.
pub fn access(report: &Report) -> &'static str {
    match report.has_key {
        true => "needs the key to upload, home, arm, run and clear faults",
        false => "open: anybody on the line may upload and arm; `rrr set-key` changes that",
    }
}
