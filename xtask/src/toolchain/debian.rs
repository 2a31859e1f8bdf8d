//! Debian's own compiler, for machines that do not reach rustup's server.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result};

use super::sysroot::{self, RUSTC};
use super::target::TARGET;
use crate::command::{capture, say};
use crate::packages;

/// The clippy that belongs to Debian's compiler.
pub const CARGO_CLIPPY: &str = "/usr/bin/cargo-clippy";

const PACKAGES: [&str; 3] = ["rustc-web", "rust-web-src", "rust-web-clippy"];

/// What `rustc -vV` tells about Debian's compiler.
pub struct Compiler {
    release: String,
    commit: String,
    /// The triple of this machine.
    pub host: String,
}

/// The sysroot made earlier for the compiler that is installed now.
pub fn existing_sysroot() -> Result<Option<PathBuf>> {
    if !Path::new(CARGO_CLIPPY).exists() {
        return Ok(None);
    }
    let Ok(compiler) = compiler() else { return Ok(None) };
    let dir = sysroot_dir(&compiler)?;
    Ok(sysroot::is_complete(&dir, &compiler.host).then_some(dir))
}

/// Installs the compiler and builds a core library for the target, once.
pub fn make_sysroot() -> Result<PathBuf> {
    packages::ensure(&PACKAGES)?;
    let compiler = compiler()?;
    let dir = sysroot_dir(&compiler)?;
    say(format!("building the core library for {TARGET} into {} (a minute)", dir.display()));
    sysroot::build(&dir, &compiler.host)?;
    Ok(dir)
}

fn compiler() -> Result<Compiler> {
    let text = capture(Command::new(RUSTC).arg("-vV"))?;
    let field = |name: &str| {
        let value = text.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(": "));
        value.map(str::to_owned).with_context(|| format!("`{RUSTC} -vV` tells no {name}"))
    };
    Ok(Compiler { release: field("release")?, commit: field("commit-hash")?, host: field("host")? })
}

/// In the user's cache, where `cargo clean` leaves it alone, one for each compiler.
fn sysroot_dir(compiler: &Compiler) -> Result<PathBuf> {
    let name = format!("{TARGET}-rustc-{}-{:.12}", compiler.release, compiler.commit);
    Ok(cache_dir()?.join("rrr").join(name))
}

fn cache_dir() -> Result<PathBuf> {
    let absolute = |name| env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    absolute("XDG_CACHE_HOME")
        .or_else(|| Some(absolute("HOME")?.join(".cache")))
        .context("no place for the sysroot: set HOME or XDG_CACHE_HOME")
}
