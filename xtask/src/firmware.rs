//! `cargo xtask firmware`: builds the images and weighs them.

use std::path::PathBuf;

use anyhow::{Result, bail};

use crate::board::Board;
use crate::command::{run as run_command, say};
use crate::image::{Image, Sizes};
use crate::toolchain::{FirmwareToolchain, TARGET};
use crate::workspace;

const PROFILE: &str = "firmware";

/// Builds the boards named, or all, prints where the images are and how large.
pub fn run(names: &[&str]) -> Result<()> {
    let boards = Board::parse(names)?;
    let toolchain = FirmwareToolchain::find_or_make()?;
    boards.into_iter().try_for_each(|board| build_and_weigh(&toolchain, board).map(drop))
}

/// Builds one image, prints its path and its sizes, and checks them.
pub fn build_and_weigh(toolchain: &FirmwareToolchain, board: Board) -> Result<Image> {
    let image = build(toolchain, board)?;
    let sizes = image.sizes()?;
    println!("{}: {}", board.name(), image.path().display());
    println!("{}: {sizes}", board.name());
    check(board, sizes)?;
    Ok(image)
}

/// Builds a board's image.
pub fn build(toolchain: &FirmwareToolchain, board: Board) -> Result<Image> {
    build_binary(toolchain, board.binary())
}

/// Builds the image of a binary.
pub fn build_binary(toolchain: &FirmwareToolchain, binary: &str) -> Result<Image> {
    say(format!("building the firmware {binary}"));
    let mut cargo = toolchain.cargo("build");
    cargo.args(["--quiet", "--profile", PROFILE]).args(package_arguments(binary));
    run_command(&mut cargo)?;
    Image::read(&image_path(binary))
}

/// Selects a binary, with the feature of the same name that it requires.
pub fn package_arguments(binary: &str) -> [&str; 6] {
    ["--package", "firmware", "--bin", binary, "--features", binary]
}

fn image_path(binary: &str) -> PathBuf {
    workspace::firmware_target_dir().join(TARGET).join(PROFILE).join(binary)
}

fn check(board: Board, sizes: Sizes) -> Result<()> {
    match board.limits() {
        Some(limits) if !sizes.fit(limits) => {
            bail!("the image for {} is too large: {sizes}; at most {limits}", board.name())
        }
        _ => Ok(()),
    }
}
