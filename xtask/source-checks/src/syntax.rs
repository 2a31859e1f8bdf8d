//! Reading files of Rust.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use syn::{Attribute, Expr, ExprLit, File, Item, ItemMod, Lit, Meta, MetaNameValue};

/// A file of Rust and its text.
pub fn read(path: &Path) -> Result<(File, String)> {
    let text =
        std::fs::read_to_string(path).with_context(|| format!("cannot read {}", path.display()))?;
    let at = |error: syn::Error| error.span().start().line;
    let file = syn::parse_file(&text)
        .map_err(|error| anyhow::anyhow!("{}:{}: {error}", path.display(), at(error.clone())))?;
    Ok((file, text))
}

/// Whether something is compiled for tests alone: `#[cfg(test)]` or `#[cfg(all(test, ..))]`.
pub fn is_for_tests(attributes: &[Attribute]) -> bool {
    let condition = |attribute: &Attribute| match &attribute.meta {
        Meta::List(list) if list.path.is_ident("cfg") => list.tokens.to_string(),
        _ => String::new(),
    };
    attributes.iter().map(condition).any(|condition| {
        let words: Vec<&str> = condition.split(|c: char| !c.is_alphanumeric()).collect();
        words.contains(&"test") && !words.contains(&"not") && !words.contains(&"any")
    })
}

/// The attributes of an item.
pub fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::ExternCrate(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::ForeignMod(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Macro(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Static(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Trait(item) => &item.attrs,
        Item::TraitAlias(item) => &item.attrs,
        Item::Type(item) => &item.attrs,
        Item::Union(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => &[],
    }
}

/// Where a module's code is, and where the files of its own modules are.
#[derive(Clone, Debug)]
pub struct Place {
    /// The file that holds the code.
    pub file: PathBuf,
    /// The directory of the files of its modules.
    pub directory: PathBuf,
}

impl Place {
    /// A crate's first file.
    pub fn of_root(file: &Path) -> Self {
        Self { file: file.to_owned(), directory: parent(file).to_owned() }
    }

    /// A file of a module, whose own modules are beside `mod.rs` or in a folder of its name.
    pub fn of_file(file: PathBuf) -> Self {
        let is_first = |name| ["mod.rs", "lib.rs", "main.rs"].iter().any(|first| *first == name);
        let is_mod = file.file_name().is_some_and(is_first);
        let directory = if is_mod { parent(&file).to_owned() } else { file.with_extension("") };
        Self { file, directory }
    }

    /// Where `mod name;` or `mod name { .. }` in this module has its code.
    pub fn of_child(&self, module: &ItemMod) -> Self {
        let name = module.ident.to_string();
        let name = name.trim_start_matches("r#");
        if module.content.is_some() {
            return Self { file: self.file.clone(), directory: self.directory.join(name) };
        }
        if let Some(path) = module.attrs.iter().find_map(path_attribute) {
            return Self::of_root(&normal(&parent(&self.file).join(path)));
        }
        let beside = self.directory.join(format!("{name}.rs"));
        let within = self.directory.join(name).join("mod.rs");
        Self::of_file(if beside.is_file() { beside } else { within })
    }
}

/// The file that `#[path = ".."]` names.
fn path_attribute(attribute: &Attribute) -> Option<String> {
    match &attribute.meta {
        Meta::NameValue(MetaNameValue {
            path,
            value: Expr::Lit(ExprLit { lit: Lit::Str(file), .. }),
            ..
        }) if path.is_ident("path") => Some(file.value()),
        _ => None,
    }
}

fn parent(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new(""))
}

/// The path without `..`.
fn normal(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| path.to_owned())
}
