//! The one message where columns are not found: what there is, what is needed, what to write.

use super::view::OWN;
use crate::error::Problem;
use crate::foreign::Stream;
use crate::guess::{Looked, guess, look};
use crate::quantity::Quantity;

/// Columns named in a message at most; the rest is counted.
const MOST_NAMES: usize = 60;

/// The name of a stream that the mapping does not have.
pub(super) const UNUSED: &str = "";

/// A stream that was read, with its name in the mapping.
pub(super) struct Found<'a> {
    pub(super) name: &'a str,
    pub(super) file: &'a str,
    pub(super) stream: &'a Stream,
}

/// The problem: what is missing, the columns found, those needed, and lines that map them.
pub(super) fn unmapped(missing: &[String], found: &[Found], needed: &[String]) -> Problem {
    let mut text = match missing {
        [one] => format!("the column {one} is missing"),
        several => format!("the columns {} are missing", several.join(", ")),
    };
    for found in found {
        text += &format!("\n  found in {}: {}", place(found), names(found.stream));
    }
    text += &format!("\n  needed: {}", needed.join(", "));
    text += "\n  dataset.toml would say, as far as names tell:\n    [columns]";
    for line in lines(found, missing) {
        text += &format!("\n    {line}");
    }
    Problem::Unmapped(text)
}

fn place(found: &Found) -> String {
    let Found { name, file, stream } = found;
    let topic = if stream.name.is_empty() { String::new() } else { format!(", {}", stream.name) };
    let stream = match *name {
        OWN => String::new(),
        UNUSED => " (not used; [streams.NAME] with its topic or time would)".to_owned(),
        name => format!(" (stream {name})"),
    };
    format!("{file}{topic}{stream}")
}

fn names(stream: &Stream) -> String {
    let all: Vec<&str> = stream.table.names().collect();
    match all.len().checked_sub(MOST_NAMES) {
        None | Some(0) => all.join(", "),
        Some(rest) => format!("{} and {rest} more", all[..MOST_NAMES].join(", ")),
    }
}

/// Lines that are guessed, and one for each missing column of which nothing tells.
fn lines(found: &[Found], missing: &[String]) -> Vec<String> {
    let mut lines = Vec::new();
    let mut told: Vec<String> = Vec::new();
    for found in found.iter().filter(|found| found.name != UNUSED) {
        let looked: Vec<Looked> = look(&found.stream.name, &found.stream.table);
        let stream = if found.name == OWN { "" } else { found.name };
        for guess in guess(&looked, None) {
            let name = guess.quantity.name();
            if !told.contains(&name) && guess.column != name {
                lines.push(guess.line(stream));
                told.push(name);
            }
        }
    }
    let first = |names: &String| names.split(' ').next().unwrap_or_default().to_owned();
    for name in missing.iter().map(first).filter(|name| Quantity::of(name).is_some()) {
        if !told.contains(&name) {
            let unit = Quantity::of(&name).and_then(|quantity| quantity.units().first().copied());
            let unit = unit.map_or("", |(unit, _)| unit);
            lines.push(format!("{name} = {{ column = \"..\", unit = \"{unit}\" }}"));
        }
    }
    lines
}
