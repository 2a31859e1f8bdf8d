//! A log's table from the files of others.

use std::collections::BTreeMap;
use std::path::Path;

use super::assemble::Wanted;
use super::lane::Times;
use super::log::{Log, Mapped};
use super::message::{Found, UNUSED, unmapped};
use super::source::Source;
use super::spec::StreamSource;
use super::view::{OWN, View};
use crate::error::{FileError, LocatedProblem, Problem};
use crate::foreign::{self, Stream, Wanted as WantedNames};
use crate::guess::{guess, names_alone};
use crate::quantity::{Quantity, Role};

/// What a log needs.
#[derive(Clone, Copy, Debug)]
pub struct Needs<'a> {
    /// Columns that must be there, or one of several: `q1_rad (or q1_count)`.
    pub required: &'a [String],
    /// What messages say beside them.
    pub beside: &'a str,
}

/// Reads a log by a mapping; columns that are called as in a log need none.
///
/// # Errors
/// Names the file, and what is wrong: where columns are missing, all that were found and that are
/// needed, and lines to write.
pub fn read(directory: &Path, file: &str, view: &View, needs: Needs) -> Result<Mapped, FileError> {
    let opened = Opened::read(directory, file, view, &|name| view.wants(name))?;
    match opened.mapped(view, needs) {
        Ok(mapped) => Ok(mapped),
        Err(Fault::Missing(missing)) => Err(explain(directory, file, view, missing, needs)),
        Err(Fault::Other(fault)) => Err(fault.in_file(&directory.join(file))),
    }
}

/// The error of a log that lacks columns: all that it has, and what to write.
pub fn explain(
    directory: &Path,
    file: &str,
    view: &View,
    mut missing: Vec<String>,
    needs: Needs,
) -> FileError {
    let opened = match Opened::read(directory, file, view, &|_| true) {
        Ok(opened) => opened,
        Err(error) => return error,
    };
    let mut known = Vec::new();
    let wanted: Vec<Vec<Wanted>> =
        opened.sources.iter().map(|source| source.wanted(view, &mut known)).collect();
    opened.sources.iter().for_each(|source| drop(source.times(view, &mut known)));
    for name in known.into_iter().chain(not_there(needs.required, &wanted)) {
        if !missing.contains(&name) {
            missing.push(name);
        }
    }
    opened.unmapped(&missing, needs).in_file(&directory.join(file))
}

/// Whether a text is no log of this tool: whatever splits its fields, none is called `t_s`.
pub fn lacks_time(path: &Path) -> bool {
    let streams = foreign::read(path, &|_| false).unwrap_or_default();
    let has_time = |stream: &Stream| stream.table.names().any(|name| name == "t_s");
    !streams.is_empty() && !streams.iter().any(has_time)
}

/// Why a log cannot be put together.
enum Fault {
    /// Columns that were not found.
    Missing(Vec<String>),
    Other(LocatedProblem),
}

impl<P: Into<LocatedProblem>> From<P> for Fault {
    fn from(problem: P) -> Self {
        Self::Other(problem.into())
    }
}

/// All streams of a log, its own first.
struct Opened {
    sources: Vec<Source>,
    /// All streams of each file.
    files: BTreeMap<String, Vec<Stream>>,
}

impl Opened {
    fn read(
        directory: &Path,
        file: &str,
        view: &View,
        wanted: WantedNames,
    ) -> Result<Self, FileError> {
        let mut files: BTreeMap<String, Vec<Stream>> = BTreeMap::new();
        let mut sources = Vec::new();
        for name in [OWN].into_iter().chain(view.other_streams()) {
            let said = view.stream(name);
            let of_stream = view.files.get(name).or(said.file.as_ref());
            let file = of_stream.map_or(file, String::as_str).to_owned();
            let path = directory.join(&file);
            if !files.contains_key(&file) {
                files.insert(file.clone(), foreign::read(&path, wanted)?);
            }
            let columns = columns_of(view, name);
            let picked = pick(&files[&file], &said, &columns);
            let stream = picked.map_err(|problem| problem.in_file(&path))?.clone();
            sources.push(Source { name: name.to_owned(), file, said, stream });
        }
        Ok(Self { sources, files })
    }

    fn mapped(&self, view: &View, needs: Needs) -> Result<Mapped, Fault> {
        let Some((own, others)) = self.sources.split_first() else {
            return Err(Problem::NoSamples.into());
        };
        let mut missing = Vec::new();
        let wanted: Vec<Vec<Wanted>> =
            self.sources.iter().map(|source| source.wanted(view, &mut missing)).collect();
        let times: Vec<Option<Times>> =
            self.sources.iter().map(|source| source.times(view, &mut missing)).collect();
        missing.extend(not_there(needs.required, &wanted));
        let (Some(Some(own_times)), true) = (times.first(), missing.is_empty()) else {
            return Err(Fault::Missing(missing));
        };
        let origin = own_times.origin(&own.stream.table);
        let mut log = Log::of(own, own_times, &wanted[0], origin, view)?;
        for ((other, times), wanted) in others.iter().zip(&times[1..]).zip(&wanted[1..]) {
            if let Some(times) = times {
                log.add(other, times, wanted, origin, view)?;
            }
        }
        Ok(log.mapped()?)
    }

    fn unmapped(&self, missing: &[String], needs: Needs) -> Problem {
        let beside = Some(needs.beside.to_owned()).filter(|beside| !beside.is_empty());
        let needed: Vec<String> = needs.required.iter().cloned().chain(beside).collect();
        let sources = self.sources.iter();
        let found = sources.map(|Source { name, file, stream, .. }| Found { name, file, stream });
        let mut found: Vec<Found> = found.collect();
        for (file, stream) in
            self.files.iter().flat_map(|(file, streams)| streams.iter().map(move |s| (file, s)))
        {
            if !self.sources.iter().any(|source| source.file == *file && source.stream == *stream) {
                found.push(Found { name: UNUSED, file, stream });
            }
        }
        unmapped(missing, &found, &needed)
    }
}

/// The columns that a stream should have.
fn columns_of<'a>(view: &'a View, stream: &str) -> Vec<&'a str> {
    let stream = if stream == OWN { "" } else { stream };
    let sources = view.columns.values().filter(|source| source.stream == stream);
    sources.map(|source| source.column.as_str()).collect()
}

/// The stream of a topic, or the one with most of the columns.
fn pick<'a>(
    streams: &'a [Stream],
    said: &StreamSource,
    columns: &[&str],
) -> Result<&'a Stream, Problem> {
    let names = || streams.iter().map(|stream| stream.name.as_str()).collect::<Vec<_>>().join(", ");
    if let Some(topic) = &said.topic {
        let found = streams.iter().find(|stream| stream.name == *topic);
        return found.ok_or_else(|| {
            Problem::Contradiction(format!("the topic {topic} is not in it; topics: {}", names()))
        });
    }
    let time = said.time.as_ref().map(|time| time.column.as_str());
    let count = |stream: &&Stream| {
        let is_there = |name: &&str| stream.table.names().any(|other| other == *name);
        let of_log = stream.table.names().filter(|name| Quantity::of(name).is_some()).count();
        let has_time = usize::from(time.is_some_and(|time| is_there(&time)));
        let told = 1000 * has_time + columns.iter().filter(|name| is_there(name)).count() + of_log;
        (told, positions(stream))
    };
    // Of equals the first.
    streams.iter().rev().max_by_key(count).ok_or(Problem::NoSamples)
}

/// How many positions a stream has by the names of its columns.
fn positions(stream: &Stream) -> usize {
    let guesses = guess(&names_alone(&stream.name, &stream.table), None);
    let roles = guesses.iter().map(|guess| guess.quantity.role);
    roles.filter(|role| matches!(role, Role::Position | Role::Count)).count()
}

/// What the log needs and no stream has: `q1_rad (or q1_count)` is there if one of them is.
fn not_there(needed: &[String], wanted: &[Vec<Wanted>]) -> Vec<String> {
    let there: Vec<String> = wanted.iter().flatten().map(|wanted| wanted.quantity.name()).collect();
    let is_there = |names: &&String| {
        let mut words = names.split(|letter: char| !letter.is_alphanumeric() && letter != '_');
        words.any(|word| word == "t_s" || there.iter().any(|name| name == word))
    };
    needed.iter().filter(|names| !is_there(names)).cloned().collect()
}
