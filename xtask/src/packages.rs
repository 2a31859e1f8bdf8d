//! Debian packages, installed when they are missing.

use std::process::Command;

use anyhow::{Context, Result, bail};

use crate::command::{capture, find_program, say};

/// Installs those of the packages that are not there, and says so before.
pub fn ensure(packages: &[&str]) -> Result<()> {
    let missing: Vec<&str> = packages.iter().copied().filter(|name| !is_installed(name)).collect();
    if missing.is_empty() {
        return Ok(());
    }
    if find_program("apt-get").is_none() {
        bail!("needed and not there: {}; install them (no apt-get here)", missing.join(", "));
    }
    say(format!("installing Debian packages: {}", missing.join(" ")));
    install(&missing)
        .with_context(|| format!("cannot install {}; do it by hand", missing.join(" ")))
}

fn is_installed(package: &str) -> bool {
    let query = ["--show", "--showformat=${db:Status-Status}", package];
    capture(Command::new("dpkg-query").args(query)).is_ok_and(|status| status == "installed")
}

/// Fetches the package lists only if the ones at hand, if any, do not serve.
fn install(packages: &[&str]) -> Result<()> {
    let arguments = [&["install", "--yes", "--no-install-recommends"], packages].concat();
    if apt_get(&arguments).is_ok() {
        return Ok(());
    }
    say("fetching newer package lists first (apt-get update)");
    apt_get(&["update"])?;
    apt_get(&arguments)
}

fn apt_get(arguments: &[&str]) -> Result<()> {
    let prefix: &[&str] = if is_root()? { &["env"] } else { &["sudo", "env"] };
    let words = [prefix, &["DEBIAN_FRONTEND=noninteractive", "apt-get", "-qq"], arguments].concat();
    capture(Command::new(words[0]).args(&words[1..]))?;
    Ok(())
}

fn is_root() -> Result<bool> {
    Ok(capture(Command::new("id").arg("-u"))? == "0")
}
