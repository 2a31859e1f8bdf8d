//! A problem with its place and its file.

use std::path::{Path, PathBuf};

use super::hint::hint;
use super::place::Place;
use super::problem::Problem;

/// A file that cannot be used: which one, where in it, and why.
#[derive(Debug, thiserror::Error)]
pub struct FileError {
    /// The file or directory.
    pub path: PathBuf,
    /// Where in the file, as far as that is known.
    pub place: Place,
    /// What is wrong there.
    #[source]
    pub problem: Problem,
}

/// A problem and its place, before the file's name is known.
#[derive(Debug)]
pub struct LocatedProblem {
    /// Where in the file.
    pub place: Place,
    /// What is wrong there.
    pub problem: Problem,
}

impl LocatedProblem {
    /// The same problem where lines mean nothing.
    pub fn without_line(self) -> Self {
        Self { place: Place { line: None, ..self.place }, ..self }
    }

    /// The error, once the file is known.
    pub fn in_file(self, path: &Path) -> FileError {
        FileError { path: path.to_owned(), place: self.place, problem: self.problem }
    }
}

impl From<Problem> for LocatedProblem {
    fn from(problem: Problem) -> Self {
        problem.at(Place::default())
    }
}

impl Problem {
    /// The problem at a place, before the file's name is known.
    pub fn at(self, place: Place) -> LocatedProblem {
        LocatedProblem { place, problem: self }
    }

    /// The problem of a whole file.
    pub fn in_file(self, path: &Path) -> FileError {
        LocatedProblem::from(self).in_file(path)
    }
}

impl FileError {
    /// What the user can do about it.
    pub fn hint(&self) -> &'static str {
        hint(&self.problem, &self.path)
    }
}

impl std::fmt::Display for FileError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.path.display())?;
        if let Some(line) = self.place.line {
            write!(f, ", line {line}")?;
        }
        if let Some(column) = &self.place.column {
            write!(f, ", column {column}")?;
        }
        write!(f, ": {}", self.problem)
    }
}
