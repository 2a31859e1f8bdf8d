//! What the Python package `rrr` calls of the project: the same functions as the command `rrr`.
//!
//! | file | holds |
//! | --- | --- |
//! | `diagnosis.rs` | a diagnosis, its report and its pages |
//! | `identification.rs` | the model of an unknown robot |
//! | `model.rs` | robot and model files, and inverse dynamics over arrays |
//! | `arrays.rs` | numpy arrays as rows |
//! | `work.rs` | long work on a thread of its own, progress, Ctrl-C |
//! | `failure.rs` | failures as exceptions, in the command line's words |
#![forbid(unsafe_code)]

mod arrays;
mod diagnosis;
mod failure;
mod identification;
mod model;
mod work;

use pyo3::prelude::*;

#[pymodule]
mod _rrr {
    #[pymodule_export]
    use crate::diagnosis::{Diagnosed, default_criteria, diagnose};
    #[pymodule_export]
    use crate::failure::Error;
    #[pymodule_export]
    use crate::identification::identify;
    #[pymodule_export]
    use crate::model::Model;
}
