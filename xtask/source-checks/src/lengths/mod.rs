//! How long functions and files are, tests apart.

mod measure;
mod walk;

use std::collections::BTreeMap;
use std::fmt::Display;
use std::path::Path;

use anyhow::Result;

use measure::Measured;

/// How many of the longest are shown.
const SHOWN: usize = 10;

/// Prints the lengths of what is in a directory.
pub fn run(directory: &Path) -> Result<()> {
    let directory = directory.canonicalize()?;
    let files = walk::measured(&directory)?;
    print_packages(&files);
    let functions = files.iter().flat_map(|file| {
        let place = |line| format!("{}:{line}", file.path.display());
        file.functions.iter().map(move |f| (f.lines, format!("{} {}", place(f.line), f.name)))
    });
    print_lengths("functions", functions.collect());
    let files = files.iter().map(|file| (file.lines, file.path.display().to_string()));
    print_lengths("files", files.collect());
    Ok(())
}

fn print_packages(files: &[Measured]) {
    let mut packages: BTreeMap<String, [usize; 4]> = BTreeMap::new();
    for file in files {
        let counts = [1, file.lines, file.code, file.functions.len()];
        for name in [file.package.display().to_string(), "~ all".to_owned()] {
            let sums = packages.entry(name).or_default();
            sums.iter_mut().zip(counts).for_each(|(sum, count)| *sum += count);
        }
    }
    print_row("package", ["files", "lines", "code", "functions"]);
    packages.iter().for_each(|(name, sums)| print_row(name.trim_start_matches("~ "), *sums));
    println!("code: lines that are neither empty nor comment");
}

fn print_row(name: &str, cells: [impl Display; 4]) {
    println!("{name:<28}{}", cells.map(|cell| format!("{cell:>10}")).concat());
}

fn print_lengths(kind: &str, mut lengths: Vec<(usize, String)>) {
    lengths.sort_unstable_by(|a, b| b.cmp(a));
    let at = |share: f64| {
        let from_longest = (1.0 - share) * lengths.len().saturating_sub(1) as f64;
        lengths.get(from_longest.round() as usize).map_or(0, |(lines, _)| *lines)
    };
    let count = lengths.len();
    println!("\n{kind}: {count}; lines: median {}, 90th percentile {}", at(0.5), at(0.9));
    for (lines, place) in lengths.iter().take(SHOWN) {
        println!("{lines:>6}  {place}");
    }
}

#[cfg(test)]
mod tests;
