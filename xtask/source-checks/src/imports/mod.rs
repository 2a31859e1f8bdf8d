//! No two files import each other in a circle, and no two folders do.
//!
//! A file imports another if its code names an item that is defined there, tests and
//! re-exports apart. For every directory, the graph among what is directly in it, a
//! file or a whole folder each, must be free of circles; `mod.rs` is a file like others.
//! So a folder imports neither a file beside it nor a folder beside it that imports it.

mod circles;
mod edges;
mod names;
mod resolve;
mod tree;

use std::collections::BTreeSet;
use std::path::Path;

use anyhow::{Result, bail};

use crate::crates::{Crate, of_workspace};
use edges::Edge;
use tree::Tree;

/// Prints the circles of a workspace, and fails if there is one.
pub fn run(directory: &Path) -> Result<()> {
    let directory = directory.canonicalize()?;
    let edges = edges(&of_workspace(&directory)?, &directory)?;
    let circles = circles::find(&edges);
    for circle in &circles {
        println!("{circle}");
    }
    match circles.len() {
        0 => Ok(()),
        count => bail!("circles of imports: {count}"),
    }
}

fn edges(crates: &[Crate], directory: &Path) -> Result<BTreeSet<Edge>> {
    Ok(edges::find(&Tree::read(crates)?, crates, directory))
}

#[cfg(test)]
mod tests;
