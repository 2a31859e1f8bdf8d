//! Failures as Python exceptions, in the words of the command line.

use files::FileError;
use host_tool::failure::Failure;
use pyo3::exceptions::PyException;
use pyo3::{PyErr, create_exception};

create_exception!(
    rrr,
    Error,
    PyException,
    "What is wrong with a file, its logs or arrays, and a remedy."
);

/// The exception of a failure; its text has the hint in its second line.
pub fn exception(failure: &Failure) -> PyErr {
    let Failure { message, hint, .. } = failure;
    match hint.is_empty() {
        true => Error::new_err(message.clone()),
        false => Error::new_err(format!("{message}\nhint: {hint}")),
    }
}

/// That of a file.
pub fn file_exception(error: FileError) -> PyErr {
    exception(&error.into())
}
