//! `cargo xtask test`: the tests of all packages, the emulated board's included.

use std::collections::BTreeSet;
use std::fs;
use std::process::Command;

use anyhow::Result;
use test_support::{IMAGE_VARIABLE, SKIPPED_VARIABLE};

use crate::board::Board;
use crate::check_elf;
use crate::command::{cargo, run as run_command, run_beside, say};
use crate::emulate;
use crate::emulator;
use crate::firmware;
use crate::image::Image;
use crate::python;
use crate::toolchain::FirmwareToolchain;
use crate::workspace;

/// Which tests are run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Length {
    /// Those that are not ignored.
    Short,
    /// Those, too, that take minutes each and are ignored for that.
    Long,
}

/// Builds, weighs and checks the images, then runs the tests of all packages.
pub fn run(length: Length) -> Result<()> {
    let toolchain = FirmwareToolchain::find_or_make()?;
    emulator::ensure()?;
    say("building the tests and the images");
    let (qemu, nucleo) = run_beside(tests().arg("--no-run"), || {
        let qemu = build_and_check(&toolchain, Board::Qemu)?;
        let nucleo = build_and_check(&toolchain, Board::Nucleo)?;
        // Downloads more than it computes.
        python::prepare();
        Ok((qemu, nucleo))
    })?;
    run_tests(&qemu, length)?;
    python::test()?;
    emulate::test(&nucleo)
}

/// The tests of all packages, but for the Python module, which [`python::test`] builds for the
/// interpreter that it finds.
fn tests() -> Command {
    let mut test = cargo("test");
    test.args(["--quiet", "--release", "--workspace", "--exclude", python::PACKAGE]);
    test
}

fn run_tests(image: &Image, length: Length) -> Result<()> {
    say("running the tests of all packages");
    let list = workspace::target_dir().join("skipped-tests.txt");
    fs::write(&list, "")?;
    let mut test = tests();
    if length == Length::Long {
        test.args(["--", "--include-ignored"]);
    }
    test.env(IMAGE_VARIABLE, image.path()).env(SKIPPED_VARIABLE, &list);
    run_command(&mut test)?;
    say(summary(&fs::read_to_string(list)?));
    Ok(())
}

/// How many tests were skipped, from their lines.
fn summary(lines: &str) -> String {
    let test = |line| str::split_once(line, ", because").map(|(test, _)| test);
    match lines.lines().filter_map(test).collect::<BTreeSet<_>>().len() {
        0 => "no test was skipped".to_owned(),
        count => format!("tests skipped, as said above: {count}"),
    }
}

fn build_and_check(toolchain: &FirmwareToolchain, board: Board) -> Result<Image> {
    let image = firmware::build_and_weigh(toolchain, board)?;
    check_elf::check(board, &image)?;
    Ok(image)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_test_that_misses_two_things_counts_once() {
        let lines = "skipped: a, because x is absent\nskipped: a, because y is absent\n\
                     skipped: b, because x is absent\n";
        assert!(summary(lines).ends_with(": 2"), "{}", summary(lines));
        assert_eq!(summary(""), "no test was skipped");
    }
}
