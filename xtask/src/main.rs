//! The project's chores, called as `cargo xtask <task>`.

mod bench;
mod board;
mod call_graph;
mod check_elf;
mod code;
mod command;
mod demo;
mod emulate;
mod emulator;
mod firmware;
mod function_costs;
mod fuzz;
mod image;
mod lint;
mod packages;
mod python;
mod setup;
mod soak;
mod source;
mod test;
mod thumb;
mod toolchain;
mod workspace;
mod worst_case;

use std::process::ExitCode;

use anyhow::{Result, bail};
use test::Length;

const HELP: &str = "\
The project's chores: cargo xtask <task>

  setup                     find or make all that the firmware and its emulator need
  firmware [qemu|nucleo]    build the images, print their paths and sizes, check the limits
  check-elf [qemu|nucleo]   check that the control tick neither computes in f64 nor panics
  test                      all of that, then the tests of all packages, the emulated board's too
  test --long               the same with those that take minutes each
  python                    the wheel of the Python module, its tests, types and notebook
  lint                      imports, formatting and clippy, on the host and for every image
  imports [DIR]             the circles in which files or folders import each other
  lengths [DIR]             how long functions and files are, tests apart
  bench [filter]            the benchmarks of all packages
  fuzz [target] [--runs N]  damaged inputs for all that takes bytes from outside (docs/fuzzing.md)
  function-costs            what elementary functions cost on the board's core, counted in QEMU
  emulate [--tcp 5555]      the NUCLEO's image on an emulated board, its line at a TCP port
  emulate --soak            its tests at their full length (docs/emulator.md)
  emulate --soak --hours 1  sessions at it that end in every way, for so long
  emulate --ticks           what the tick takes in each reference and mode (docs/board.md)
  soak [--hours 24]         a simulated day of the whole board at a noisy line
  demo                      the host tool against the firmware on the emulated board

Environment:
  CARGO_TARGET_DIR          where to build, instead of target/
  RRR_REQUIRE_DATA          1: tests fail without the collected data instead of being skipped
  RRR_FIRMWARE_TOOLCHAIN    `debian`: use Debian's compiler even where rustup has the target";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments.iter().map(String::as_str).collect::<Vec<_>>()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("xtask: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &[&str]) -> Result<()> {
    match arguments {
        [] | ["help" | "--help" | "-h"] => {
            println!("{HELP}");
            Ok(())
        }
        ["setup"] => setup::run(),
        ["firmware", boards @ ..] => firmware::run(boards),
        ["check-elf", boards @ ..] => check_elf::run(boards),
        ["test"] => test::run(Length::Short),
        ["test", "--long"] => test::run(Length::Long),
        ["python"] => python::test(),
        ["lint"] => lint::run(),
        [check @ ("imports" | "lengths"), directory @ ..] => source::run(check, directory),
        ["bench", filter @ ..] => bench::run(filter),
        ["fuzz", arguments @ ..] => fuzz::run(arguments),
        ["function-costs"] => function_costs::run(),
        ["emulate", arguments @ ..] => emulate::run(arguments),
        ["soak", arguments @ ..] => soak::run(arguments),
        ["demo"] => demo::run(),
        [task, ..] => bail!("`{task}` is no task, or not with these arguments\n\n{HELP}"),
    }
}
