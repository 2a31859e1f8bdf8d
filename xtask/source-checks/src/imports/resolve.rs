//! Where the item that a path names is defined.

use super::tree::Tree;

/// What a path leads to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// An item that is defined in this module, or something of the item.
    Item(usize),
    /// A module as such.
    Module(usize),
}

impl Target {
    /// Where the item is defined; none if it is a module.
    pub fn item(self) -> Option<usize> {
        match self {
            Self::Item(module) => Some(module),
            Self::Module(_) => None,
        }
    }

    fn module(self) -> Option<usize> {
        match self {
            Self::Item(_) => None,
            Self::Module(module) => Some(module),
        }
    }
}

impl Tree {
    /// What a path in a module leads to, through every re-export; nothing if it leads
    /// out of the workspace. One name may be a module's and a function's.
    pub fn resolve(&self, module: usize, path: &[String]) -> Vec<Target> {
        Search { tree: self, followed: Vec::new() }.from(module, path)
    }
}

/// A search for a name.
struct Search<'t> {
    tree: &'t Tree,
    /// The imports being followed, none of which is followed twice.
    followed: Vec<(usize, usize)>,
}

impl Search<'_> {
    fn from(&mut self, module: usize, path: &[String]) -> Vec<Target> {
        let Some((first, rest)) = path.split_first() else { return Vec::new() };
        if first.is_empty() {
            return self.in_library(rest);
        }
        if matches!(first.as_str(), "crate" | "self" | "super") {
            return self.below(module, path);
        }
        match self.named(module, first, rest) {
            found if found.is_empty() => self.in_library(path),
            found => found,
        }
    }

    fn in_library(&mut self, path: &[String]) -> Vec<Target> {
        let Some((name, rest)) = path.split_first() else { return Vec::new() };
        let library = self.tree.libraries.get(name).copied();
        library.map_or_else(Vec::new, |library| self.below(library, rest))
    }

    fn below(&mut self, module: usize, path: &[String]) -> Vec<Target> {
        let at = &self.tree.modules[module];
        let Some((first, rest)) = path.split_first() else { return vec![Target::Module(module)] };
        match first.as_str() {
            "self" => self.below(module, rest),
            "crate" => self.below(at.root, rest),
            "super" => at.parent.map_or_else(Vec::new, |parent| self.below(parent, rest)),
            _ => self.named(module, first, rest),
        }
    }

    /// What is called `name` in a module, and `rest` within that.
    fn named(&mut self, module: usize, name: &str, rest: &[String]) -> Vec<Target> {
        let at = &self.tree.modules[module];
        let mut found = Vec::new();
        if at.names.items.get(name).is_some_and(|&is_type| is_type || rest.is_empty()) {
            found.push(Target::Item(module));
        }
        if let Some(&child) = at.children.get(name) {
            found.extend(self.below(child, rest));
        }
        for (number, import) in at.names.imports.iter().enumerate() {
            if import.name.as_deref() == Some(name) {
                let path = [&import.path.words, rest].concat();
                found.extend(self.through((module, number), |search| search.from(module, &path)));
            }
        }
        if found.is_empty() { self.in_globs(module, name, rest) } else { found }
    }

    /// The same among what a module imports by `*`.
    fn in_globs(&mut self, module: usize, name: &str, rest: &[String]) -> Vec<Target> {
        let mut found = Vec::new();
        for (number, import) in self.tree.modules[module].names.imports.iter().enumerate() {
            if import.name.is_none() {
                found.extend(self.through((module, number), |search| {
                    let all = search.from(module, &import.path.words);
                    let modules = all.into_iter().filter_map(Target::module);
                    modules.flat_map(|module| search.named(module, name, rest)).collect()
                }));
            }
        }
        found
    }

    fn through(
        &mut self,
        import: (usize, usize),
        look: impl FnOnce(&mut Self) -> Vec<Target>,
    ) -> Vec<Target> {
        if self.followed.contains(&import) {
            return Vec::new();
        }
        self.followed.push(import);
        let found = look(self);
        self.followed.pop();
        found
    }
}
