//! The modules of all crates.

use std::collections::BTreeMap;
use std::path::PathBuf;

use anyhow::{Context, Result};
use syn::Item;

use super::names::Names;
use crate::crates::Crate;
use crate::syntax::{Place, attributes, is_for_tests, read};

/// The modules of all crates; a module is known by its number.
#[derive(Debug, Default)]
pub struct Tree {
    /// The modules, each after the one that it is in.
    pub modules: Vec<Module>,
    /// The first modules of the libraries, by the names that others import them by.
    pub libraries: BTreeMap<String, usize>,
}

/// One module of one crate.
#[derive(Debug)]
pub struct Module {
    /// Its own number.
    pub number: usize,
    /// Where its code is.
    pub file: PathBuf,
    /// Which of the crates read it belongs to.
    pub of_crate: usize,
    /// The crate's first module.
    pub root: usize,
    /// The module that it is in; none for a crate's first.
    pub parent: Option<usize>,
    /// The modules in it.
    pub children: BTreeMap<String, usize>,
    /// What its code defines and names.
    pub names: Names,
}

impl Tree {
    /// Reads the files of these crates, but what is compiled for unit tests alone.
    pub fn read(crates: &[Crate]) -> Result<Self> {
        let mut tree = Self::default();
        for (of_crate, each) in crates.iter().enumerate() {
            let root = tree.modules.len();
            tree.add_file(Place::of_root(&each.root), None, of_crate)?;
            tree.libraries.extend(each.library.clone().map(|name| (name, root)));
        }
        Ok(tree)
    }

    fn add_file(&mut self, at: Place, parent: Option<usize>, of_crate: usize) -> Result<usize> {
        let (file, _) = read(&at.file)?;
        self.add(at, &file.items, parent, of_crate)
    }

    fn add(
        &mut self,
        at: Place,
        items: &[Item],
        parent: Option<usize>,
        of_crate: usize,
    ) -> Result<usize> {
        let number = self.modules.len();
        let root = parent.map_or(number, |parent| self.modules[parent].root);
        let (file, names) = (at.file.clone(), Names::of(items));
        let children = BTreeMap::new();
        self.modules.push(Module { number, file, of_crate, root, parent, children, names });
        for item in items.iter().filter(|item| !is_for_tests(attributes(item))) {
            let Item::Mod(module) = item else { continue };
            let place = at.of_child(module);
            let child = match &module.content {
                Some((_, items)) => self.add(place, items, Some(number), of_crate),
                None => self.add_file(place, Some(number), of_crate),
            };
            let child = child.with_context(|| format!("in {}", at.file.display()))?;
            self.modules[number].children.insert(module.ident.to_string(), child);
        }
        Ok(number)
    }

    /// Whether `inner` is `outer` or within it.
    pub fn is_within(&self, inner: usize, outer: usize) -> bool {
        let mut around = std::iter::successors(Some(inner), |&m| self.modules[m].parent);
        around.any(|module| module == outer)
    }
}
