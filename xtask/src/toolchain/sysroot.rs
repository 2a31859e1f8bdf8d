//! A sysroot: the libraries of one compiler for the target and for the host.

use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{fs, process};

use anyhow::{Context, Result, bail};

use super::target::TARGET;
use crate::command::{capture, cargo, run};

/// Debian's compiler, beside the host's own.
pub const RUSTC: &str = "/usr/bin/rustc";

const LIBRARIES: [&str; 4] = ["core", "alloc", "compiler_builtins", "panic_abort"];

const MANIFEST: &str = r#"
[package]
name = "empty"
edition = "2024"
[workspace]
[profile.release]
panic = "abort"
codegen-units = 1
"#;

/// Finds the sysroot by its own place, so that it can be moved.
const WRAPPER: &str = r#"#!/bin/sh
bin="${0%/*}"
exec /usr/bin/rustc --sysroot "${bin%/bin}" "$@"
"#;

/// The compiler that uses this sysroot.
pub fn rustc(sysroot: &Path) -> PathBuf {
    sysroot.join("bin/rustc")
}

/// Whether nothing is missing, also behind the links.
pub fn is_complete(sysroot: &Path, host: &str) -> bool {
    let libraries = library_dir(sysroot, TARGET);
    rustc(sysroot).exists()
        && library_dir(sysroot, host).exists()
        && linker(sysroot, host).exists()
        && LIBRARIES.iter().all(|name| libraries.join(rlib(name)).exists())
}

/// Builds it aside and moves it into place whole, so that an interrupted build leaves none.
pub fn build(sysroot: &Path, host: &str) -> Result<()> {
    let scratch = sysroot.with_added_extension(format!("{}.tmp", process::id()));
    let result = build_in(&scratch, host).and_then(|()| put_in_place(&scratch, sysroot));
    // What is left are intermediate files; should they stay, they do no harm.
    let _ = fs::remove_dir_all(&scratch);
    result.with_context(|| format!("cannot make the sysroot {}", sysroot.display()))
}

fn build_in(scratch: &Path, host: &str) -> Result<()> {
    fs::create_dir_all(scratch.join("src"))?;
    fs::write(scratch.join("Cargo.toml"), MANIFEST)?;
    fs::write(scratch.join("src/lib.rs"), "#![no_std]\n")?;
    run(&mut build_command(scratch))?;
    lay_out(scratch, &scratch.join("sysroot"), host)
}

/// Bitcode, for link-time optimisation with the core library.
fn build_command(scratch: &Path) -> Command {
    let mut command = cargo("build");
    command.args(["--quiet", "--release", "--target", TARGET]);
    command.arg("-Zbuild-std=core,alloc,panic_abort");
    command.arg("-Zbuild-std-features=compiler-builtins-mem");
    command.current_dir(scratch).env("CARGO_TARGET_DIR", scratch.join("target"));
    command.env("RUSTC", RUSTC).env("RUSTC_BOOTSTRAP", "1");
    command.env("CARGO_ENCODED_RUSTFLAGS", "-Cembed-bitcode=yes");
    command
}

fn lay_out(scratch: &Path, sysroot: &Path, host: &str) -> Result<()> {
    let libraries = library_dir(sysroot, TARGET);
    fs::create_dir_all(&libraries)?;
    let built = scratch.join("target").join(TARGET).join("release/deps");
    for name in LIBRARIES {
        fs::copy(find_library(&built, name)?, libraries.join(rlib(name)))?;
    }
    link_host(sysroot, host)?;
    write_wrapper(&rustc(sysroot))
}

fn find_library(dir: &Path, name: &str) -> Result<PathBuf> {
    let prefix = format!("lib{name}-");
    for entry in fs::read_dir(dir)? {
        let path = entry?.path();
        let file = path.file_name().unwrap_or_default().to_string_lossy();
        if file.starts_with(&prefix) && file.ends_with(".rlib") {
            return Ok(path);
        }
    }
    bail!("the build left no {prefix}*.rlib in {}", dir.display())
}

/// Build scripts and procedural macros need the host's library; the image needs a linker.
fn link_host(sysroot: &Path, host: &str) -> Result<()> {
    let rustup = PathBuf::from(capture(Command::new("rustc").args(["--print", "sysroot"]))?);
    let debian = capture(Command::new(RUSTC).args(["--print", "sysroot"]))?;
    link(&library_dir(Path::new(&debian), host), &library_dir(sysroot, host))?;
    link(&linker(&rustup, host), &linker(sysroot, host))
}

fn link(original: &Path, link: &Path) -> Result<()> {
    fs::create_dir_all(link.parent().context("a link has a directory")?)?;
    symlink(original, link).with_context(|| format!("cannot link {}", link.display()))
}

fn write_wrapper(path: &Path) -> Result<()> {
    fs::create_dir_all(path.parent().context("a wrapper has a directory")?)?;
    fs::write(path, WRAPPER)?;
    Ok(fs::set_permissions(path, fs::Permissions::from_mode(0o755))?)
}

/// One that stands in the way is incomplete, or was made by another run just now.
fn put_in_place(scratch: &Path, sysroot: &Path) -> Result<()> {
    if sysroot.exists() {
        fs::remove_dir_all(sysroot)?;
    }
    Ok(fs::rename(scratch.join("sysroot"), sysroot)?)
}

fn library_dir(sysroot: &Path, triple: &str) -> PathBuf {
    sysroot.join("lib/rustlib").join(triple).join("lib")
}

fn linker(sysroot: &Path, host: &str) -> PathBuf {
    sysroot.join("lib/rustlib").join(host).join("bin/rust-lld")
}

fn rlib(name: &str) -> String {
    format!("lib{name}.rlib")
}
