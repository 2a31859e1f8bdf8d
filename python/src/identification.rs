//! Identification for Python.

use std::path::PathBuf;

use host_tool::commands::identify as command;
use pyo3::prelude::*;

use crate::model::Model;
use crate::work;

/// Identifies the robot of a file by the data set in a directory; its model, and remarks.
#[pyfunction]
#[pyo3(signature = (dataset, robot, progress=None))]
pub fn identify(
    py: Python<'_>,
    dataset: PathBuf,
    robot: PathBuf,
    progress: Option<Py<PyAny>>,
) -> PyResult<(Model, Vec<String>)> {
    let found = work::run(py, progress, move |steps| command::found(&dataset, &robot, steps))?;
    Ok((Model::of(found.model), found.remarks))
}
