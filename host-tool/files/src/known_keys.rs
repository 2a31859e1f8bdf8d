//! The keys that each table of a file may have; any other is refused, with its line.

use toml::de::{DeTable, DeValue};
use toml::{Spanned, de::DeString};

use super::error::{FileError, Problem};
use super::toml_source::TomlSource;

/// Keys that every table may have: they are for people, are kept and mean nothing.
pub(super) const FOR_PEOPLE: [&str; 2] = ["note", "notes"];
/// Keys with this in their name may stand beside any value: they say how well it is known.
pub(super) const STANDARD_ERROR: &str = "standard_error";

/// A table's name, empty for the whole file, and its keys.
pub(super) type TableKeys = (&'static str, &'static [&'static str]);

/// Refuses the first key that none of the tables has.
pub(super) fn check(source: &TomlSource, tables: &[TableKeys]) -> Result<(), FileError> {
    let document = source.document()?;
    tables.iter().try_for_each(|&(name, keys)| {
        tables_of(document.get_ref(), name)
            .into_iter()
            .try_for_each(|table| check_table(source, name, table, keys))
    })
}

/// All tables of a name.
fn tables_of<'a, 'i>(document: &'a DeTable<'i>, name: &str) -> Vec<&'a DeTable<'i>> {
    if name.is_empty() {
        return vec![document];
    }
    match document.get(name).map(Spanned::get_ref) {
        Some(DeValue::Table(table)) => vec![table],
        Some(DeValue::Array(values)) => {
            values.iter().filter_map(|value| value.get_ref().as_table()).collect()
        }
        _ => Vec::new(),
    }
}

fn check_table(
    source: &TomlSource,
    name: &str,
    table: &DeTable,
    keys: &[&str],
) -> Result<(), FileError> {
    let unknown = |key: &&Spanned<DeString>| {
        let key: &str = key.get_ref();
        !keys.contains(&key) && !FOR_PEOPLE.contains(&key) && !key.contains(STANDARD_ERROR)
    };
    let Some(key) = table.keys().find(unknown) else { return Ok(()) };
    let place = if name.is_empty() { "the file".to_owned() } else { format!("[{name}]") };
    let what = format!("{} is not known in {place}; known are {}", key.get_ref(), keys.join(", "));
    Err(source.problem_at(Problem::UnknownKey(what), key.span()))
}
