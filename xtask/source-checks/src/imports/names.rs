//! What a module defines, imports and names.

use std::collections::BTreeMap;

use proc_macro2::{Span, TokenStream, TokenTree};
use syn::visit::{self, Visit};
use syn::{Attribute, ImplItemFn, Item, ItemUse, Macro, Meta, UseTree, Visibility};

use crate::syntax::{attributes, is_for_tests};

/// The names of one module, without those of its own modules and without its tests.
#[derive(Debug, Default)]
pub struct Names {
    /// The items defined here; true if one may stand before `::`.
    pub items: BTreeMap<String, bool>,
    /// Its `use` declarations, also those within functions.
    pub imports: Vec<Import>,
    /// Every path in its code.
    pub paths: Vec<NamedPath>,
}

/// One name of a `use` declaration.
#[derive(Debug)]
pub struct Import {
    /// The name here; none for `*`.
    pub name: Option<String>,
    /// What is imported; for `*`, the module.
    pub path: NamedPath,
    /// Whether others can import it from here.
    pub is_public: bool,
}

/// A path and where it stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedPath {
    /// The words between `::`; an empty one first if it begins with `::`.
    pub words: Vec<String>,
    /// The line, from 1.
    pub line: usize,
}

impl Names {
    /// Reads a module's items.
    pub fn of(items: &[Item]) -> Self {
        let mut names = Self::default();
        for item in items.iter().filter(|item| !is_for_tests(attributes(item))) {
            names.define(item);
            names.visit_item(item);
        }
        names
    }

    fn define(&mut self, item: &Item) {
        let (ident, is_type) = match item {
            Item::Const(item) => (&item.ident, false),
            Item::Enum(item) => (&item.ident, true),
            Item::Fn(item) => (&item.sig.ident, false),
            Item::Macro(item) if item.ident.is_some() => (item.ident.as_ref().unwrap(), false),
            Item::Static(item) => (&item.ident, false),
            Item::Struct(item) => (&item.ident, true),
            Item::Trait(item) => (&item.ident, true),
            Item::TraitAlias(item) => (&item.ident, true),
            Item::Type(item) => (&item.ident, true),
            Item::Union(item) => (&item.ident, true),
            _ => return,
        };
        *self.items.entry(ident.to_string()).or_default() |= is_type;
    }

    fn import(&mut self, tree: &UseTree, before: &[String], span: Span, is_public: bool) {
        let with = |ident: &syn::Ident| {
            let own = (*ident != "self").then(|| ident.to_string());
            before.iter().cloned().chain(own).collect::<Vec<_>>()
        };
        let (name, words) = match tree {
            UseTree::Path(path) => {
                let words = before.iter().cloned().chain([path.ident.to_string()]);
                return self.import(&path.tree, &words.collect::<Vec<_>>(), span, is_public);
            }
            UseTree::Group(group) => {
                let each = |tree| self.import(tree, before, span, is_public);
                return group.items.iter().for_each(each);
            }
            UseTree::Name(name) => (with(&name.ident).last().cloned(), with(&name.ident)),
            UseTree::Rename(rename) => (Some(rename.rename.to_string()), with(&rename.ident)),
            UseTree::Glob(_) => (None, before.to_vec()),
        };
        let path = NamedPath { words, line: span.start().line };
        self.imports.push(Import { name, path, is_public });
    }

    /// The paths in the words of a macro, which may stand for anything.
    fn scan(&mut self, tokens: &TokenStream) {
        let mut path = NamedPath { words: Vec::new(), line: 0 };
        let (mut colons, mut after_dot) = (0, false);
        for token in tokens.clone() {
            match &token {
                TokenTree::Ident(word) if colons == 2 && !path.words.is_empty() => {
                    path.words.push(word.to_string());
                }
                TokenTree::Punct(punct) if punct.as_char() == ':' => {
                    colons += 1;
                    continue;
                }
                _ => {
                    self.paths.extend(finished(&mut path));
                    match &token {
                        TokenTree::Ident(word) if colons != 2 && !after_dot => {
                            path.words.push(word.to_string());
                            path.line = word.span().start().line;
                        }
                        TokenTree::Group(group) => self.scan(&group.stream()),
                        _ => {}
                    }
                }
            }
            colons = 0;
            after_dot = matches!(&token, TokenTree::Punct(punct) if punct.as_char() == '.');
        }
        self.paths.extend(finished(&mut path));
    }
}

fn finished(path: &mut NamedPath) -> Option<NamedPath> {
    let words = std::mem::take(&mut path.words);
    (!words.is_empty()).then_some(NamedPath { words, line: path.line })
}

impl<'ast> Visit<'ast> for Names {
    fn visit_item_mod(&mut self, _: &'ast syn::ItemMod) {}

    fn visit_visibility(&mut self, _: &'ast Visibility) {}

    fn visit_impl_item_fn(&mut self, function: &'ast ImplItemFn) {
        if !is_for_tests(&function.attrs) {
            visit::visit_impl_item_fn(self, function);
        }
    }

    fn visit_item_use(&mut self, item: &'ast ItemUse) {
        let before = if item.leading_colon.is_some() { vec![String::new()] } else { Vec::new() };
        let is_public = !matches!(item.vis, Visibility::Inherited);
        self.import(&item.tree, &before, item.use_token.span, is_public);
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let begin = path.leading_colon.as_ref().map(|_| String::new());
        let words = path.segments.iter().map(|segment| segment.ident.to_string());
        let line = path.segments.first().map_or(0, |first| first.ident.span().start().line);
        self.paths.push(NamedPath { words: begin.into_iter().chain(words).collect(), line });
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, call: &'ast Macro) {
        self.visit_path(&call.path);
        self.scan(&call.tokens);
    }

    fn visit_attribute(&mut self, attribute: &'ast Attribute) {
        if let Meta::List(list) = &attribute.meta {
            self.scan(&list.tokens);
        }
    }
}
