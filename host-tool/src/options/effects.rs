//! Effects that a simulated robot has, from its model file and from the command line.

use std::path::Path;

use super::compensation::bad_effect;
use crate::failure::Failure;
use files::EffectTable;
use rig::effects::{Catalogue, Effect, table_from_text};

const HINT: &str = "write cogging:3:amplitude_V=0.1,harmonic=8,phase_rad=0, say; \
                    docs/effects.md lists the catalogue";

/// The effects that a model file lists.
///
/// # Errors
/// A table that is no effect of the catalogue.
pub fn of_file(tables: &[EffectTable], path: &Path) -> Result<Vec<Box<dyn Effect>>, Failure> {
    of_file_in(&Catalogue::standard(), tables, path)
}

/// The same of a catalogue.
///
/// # Errors
/// A table that is no effect of the catalogue.
pub fn of_file_in(
    catalogue: &Catalogue,
    tables: &[EffectTable],
    path: &Path,
) -> Result<Vec<Box<dyn Effect>>, Failure> {
    let effect = |table| catalogue.effect_of(table);
    tables.iter().map(|table| effect(table).map_err(|error| bad_effect(path, &error))).collect()
}

/// The effects of options `--effect`.
///
/// # Errors
/// A text that is no effect of the catalogue.
pub fn of_options(texts: &[String]) -> Result<Vec<Box<dyn Effect>>, Failure> {
    of_options_in(&Catalogue::standard(), texts)
}

/// The same of a catalogue.
///
/// # Errors
/// A text that is no effect of the catalogue.
pub fn of_options_in(
    catalogue: &Catalogue,
    texts: &[String],
) -> Result<Vec<Box<dyn Effect>>, Failure> {
    texts.iter().map(|text| of_option(catalogue, text)).collect()
}

fn of_option(catalogue: &Catalogue, text: &str) -> Result<Box<dyn Effect>, Failure> {
    table_from_text(text)
        .and_then(|table| catalogue.effect_of(&table))
        .map_err(|error| Failure::new(format!("--effect {text}: {error}"), HINT))
}
