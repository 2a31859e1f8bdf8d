//! The plain runner: `fuzz-entries TARGET|all [--runs N] [--seed N]`; `fuzz-entries seeds DIR`
//! writes the good inputs of each target, for cargo-fuzz to begin from.
//!
//! Prints how many inputs each target took. An input that makes one panic is printed as bytes,
//! written to `fuzz-failure-TARGET`, and ends the program.

use std::fs::{create_dir_all, write};
use std::panic::catch_unwind;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

use fuzz_entries::mutate::mutated;
use fuzz_entries::rng::Rng;
use fuzz_entries::{TARGETS, Target};

/// What is asked for on the command line.
struct Options {
    name: String,
    runs: u64,
    seed: u64,
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [command, directory] = arguments.as_slice()
        && command == "seeds"
    {
        return write_seeds(Path::new(directory));
    }
    let Some(options) = parse(&arguments) else {
        let names = TARGETS.map(|target| target.name).join(", ");
        eprintln!("fuzz-entries TARGET|all [--runs N] [--seed N], or seeds DIR; targets: {names}");
        return ExitCode::from(2);
    };
    let wanted = |target: &&Target| options.name == "all" || options.name == target.name;
    let fine = TARGETS.iter().filter(wanted).all(|target| fuzz(target, options.runs, options.seed));
    if fine { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn write_seeds(directory: &Path) -> ExitCode {
    for target in &TARGETS {
        let folder = directory.join(target.name);
        let written = create_dir_all(&folder).and_then(|()| {
            let mut numbered = (0..).zip((target.seeds)());
            numbered.try_for_each(|(n, seed)| write(folder.join(format!("seed-{n}")), seed))
        });
        if let Err(error) = written {
            eprintln!("{}: the seeds cannot be written: {error}", folder.display());
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}

fn parse(arguments: &[String]) -> Option<Options> {
    let (name, rest) = arguments.split_first()?;
    if name != "all" && TARGETS.iter().all(|target| target.name != name) {
        return None;
    }
    let mut options = Options { name: name.clone(), runs: 100_000, seed: 1 };
    for option in rest.chunks(2) {
        let number = option.get(1)?.replace('_', "").parse().ok()?;
        match option[0].as_str() {
            "--runs" => options.runs = number,
            "--seed" => options.seed = number,
            _ => return None,
        }
    }
    Some(options)
}

/// Whether the target took all inputs.
fn fuzz(target: &Target, runs: u64, seed: u64) -> bool {
    let seeds = (target.seeds)();
    let mut rng = Rng::new(seed);
    let begin = Instant::now();
    for run in 0..runs {
        let input = if run < seeds.len() as u64 {
            seeds[run as usize].clone()
        } else {
            mutated(&seeds, &mut rng)
        };
        if catch_unwind(|| (target.run)(&input)).is_err() {
            report(target, run, &input);
            return false;
        }
    }
    let seconds = begin.elapsed().as_secs_f64();
    println!("{:16} {runs:>12} runs, none failed, {:>9.0}/s", target.name, runs as f64 / seconds);
    true
}

fn report(target: &Target, run: u64, input: &[u8]) {
    let file = format!("fuzz-failure-{}", target.name);
    println!("{}: run {run} failed on {} bytes, see {file}", target.name, input.len());
    if let Err(error) = write(&file, input) {
        println!("{file}: cannot be written: {error}; the bytes are {input:02X?}");
    }
}
