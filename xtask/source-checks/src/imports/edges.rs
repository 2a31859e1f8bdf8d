//! Which file imports which.

use std::collections::BTreeSet;
use std::fmt;
use std::path::{Path, PathBuf};

use super::names::NamedPath;
use super::resolve::Target;
use super::tree::Tree;
use crate::crates::Crate;

/// One line by which a file imports another.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Edge {
    /// The file that imports.
    pub from: PathBuf,
    /// The file that defines what is imported.
    pub to: PathBuf,
    line: usize,
    path: String,
}

impl fmt::Display for Edge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (from, to) = (self.from.display(), self.to.display());
        write!(f, "{from}:{}: {} (defined in {to})", self.line, self.path)
    }
}

/// All imports among the files of the crates, with their paths from `root`.
///
/// Nobody imports a file of tests, so what it takes from other packages is left out:
/// that a package's tests use a package built on it makes no circle.
pub fn find(tree: &Tree, crates: &[Crate], root: &Path) -> BTreeSet<Edge> {
    let relative = |file: &Path| file.strip_prefix(root).unwrap_or(file).to_owned();
    let mut edges = BTreeSet::new();
    for from in &tree.modules {
        for (path, to) in imported(tree, from.number) {
            let to = &tree.modules[to];
            let [a, b] = [from, to].map(|module| &crates[module.of_crate]);
            if from.file != to.file && (a.package == b.package || !a.is_test) {
                let [from, to] = [from, to].map(|module| relative(&module.file));
                edges.insert(Edge { from, to, line: path.line, path: path.words.join("::") });
            }
        }
    }
    edges
}

/// What a module's code takes from other modules, by `use` or by a path that needs none;
/// re-exporting what is within the module is no import.
fn imported(tree: &Tree, module: usize) -> Vec<(&NamedPath, usize)> {
    let names = &tree.modules[module].names;
    let mut imported = Vec::new();
    let mut used = Vec::new();
    for import in &names.imports {
        for target in tree.resolve(module, &import.path.words) {
            match (target, &import.name) {
                (Target::Module(_), Some(_)) => {}
                (Target::Item(target) | Target::Module(target), _)
                    if import.is_public && tree.is_within(target, module) => {}
                (Target::Item(target) | Target::Module(target), name) => {
                    used.extend(name.as_deref());
                    imported.push((&import.path, target));
                }
            }
        }
    }
    for path in names.paths.iter().filter(|path| !used.contains(&path.words[0].as_str())) {
        let items = tree.resolve(module, &path.words).into_iter().filter_map(Target::item);
        imported.extend(items.map(|target| (path, target)));
    }
    imported
}
