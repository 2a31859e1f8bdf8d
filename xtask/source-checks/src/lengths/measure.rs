//! How long one file and its functions are.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use anyhow::Result;
use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{ImplItemFn, Item, ItemFn, Signature, TraitItemFn};

use crate::syntax::{Place, attributes, is_for_tests, read};

/// A file, measured without its unit tests.
#[derive(Debug)]
pub struct Measured {
    /// The file.
    pub path: PathBuf,
    /// The directory of its package.
    pub package: PathBuf,
    /// All lines.
    pub lines: usize,
    /// Those that are neither empty nor comment.
    pub code: usize,
    /// Its functions.
    pub functions: Vec<Function>,
}

/// A function from its `fn` to its closing brace.
#[derive(Debug, PartialEq, Eq)]
pub struct Function {
    /// Its name.
    pub name: String,
    /// Where it begins.
    pub line: usize,
    /// How many lines it takes.
    pub lines: usize,
}

/// What of a file is a function, and what a test.
struct Reading {
    place: Place,
    functions: Vec<Function>,
    test_lines: BTreeSet<usize>,
    test_files: Vec<PathBuf>,
}

impl Measured {
    /// Measures a file; also tells the files and folders of its modules of tests.
    pub fn read(path: &Path, package: &Path) -> Result<(Self, Vec<PathBuf>)> {
        let (file, text) = read(path)?;
        let mut reading = Reading {
            place: Place::of_file(path.to_owned()),
            functions: Vec::new(),
            test_lines: BTreeSet::new(),
            test_files: Vec::new(),
        };
        reading.visit_file(&file);
        let is_counted = |(index, _): &(usize, &str)| !reading.test_lines.contains(&(index + 1));
        let lines = || text.lines().enumerate().filter(is_counted).map(|(_, line)| line.trim());
        let is_code = |line: &&str| !line.is_empty() && !line.starts_with("//");
        let measured = Self {
            path: path.to_owned(),
            package: package.to_owned(),
            lines: lines().count(),
            code: lines().filter(is_code).count(),
            functions: reading.functions,
        };
        Ok((measured, reading.test_files))
    }
}

impl Reading {
    fn add(&mut self, signature: &Signature, end: Span) {
        let line = signature.span().start().line;
        let lines = end.end().line - line + 1;
        self.functions.push(Function { name: signature.ident.to_string(), line, lines });
    }

    fn add_test(&mut self, item: &Item) {
        let span = item.span();
        self.test_lines.extend(span.start().line..=span.end().line);
        if let Item::Mod(module) = item
            && module.content.is_none()
        {
            let place = self.place.of_child(module);
            self.test_files.extend([place.file, place.directory]);
        }
    }
}

impl<'ast> Visit<'ast> for Reading {
    fn visit_item(&mut self, item: &'ast Item) {
        if is_for_tests(attributes(item)) {
            self.add_test(item);
        } else {
            visit::visit_item(self, item);
        }
    }

    fn visit_item_fn(&mut self, function: &'ast ItemFn) {
        self.add(&function.sig, function.block.span());
        visit::visit_item_fn(self, function);
    }

    fn visit_impl_item_fn(&mut self, function: &'ast ImplItemFn) {
        self.add(&function.sig, function.block.span());
        visit::visit_impl_item_fn(self, function);
    }

    fn visit_trait_item_fn(&mut self, function: &'ast TraitItemFn) {
        if let Some(block) = &function.default {
            self.add(&function.sig, block.span());
        }
        visit::visit_trait_item_fn(self, function);
    }
}
