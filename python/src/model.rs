//! Robot and model files for Python.

use std::path::PathBuf;

use diagnosis::ModelFile;
use files::{RobotFile, arm_log};
use host_tool::commands::inverse_dynamics::body::Body;
use numpy::{PyArrayDyn, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::arrays::{Rows, as_rows, check, shaped};
use crate::failure::{Error, file_exception};

/// What is known of a robot: a file of format 1 or 2.
#[pyclass(frozen, module = "rrr._rrr")]
pub struct Model {
    file: ModelFile,
}

impl Model {
    /// Of a file that is at hand.
    pub fn of(file: ModelFile) -> Self {
        Self { file }
    }

    fn body(&self) -> PyResult<Body> {
        let body = match &self.file {
            ModelFile::Arm(file) => Body::of_arm(file),
            ModelFile::Robot(file) => Body::of_robot(file),
        };
        body.map_err(file_exception)
    }
}

#[pymethods]
impl Model {
    /// Reads a file.
    #[staticmethod]
    fn load(path: PathBuf) -> PyResult<Self> {
        ModelFile::read(path).map(Self::of).map_err(file_exception)
    }

    /// Reads a text; `name` stands for the file in messages.
    #[staticmethod]
    fn parse(text: String, name: PathBuf) -> PyResult<Self> {
        ModelFile::parse(name, text).map(Self::of).map_err(file_exception)
    }

    /// The file's text.
    fn to_toml(&self) -> PyResult<String> {
        self.file.to_toml().map_err(|problem| Error::new_err(problem.to_string()))
    }

    /// Writes the file, whole or not at all.
    fn write(&self, path: PathBuf) -> PyResult<()> {
        self.file.write(path).map_err(file_exception)
    }

    /// Torques of motions: `q`, `qd` and `qdd` of n joints, or m x n; in the same shape.
    fn inverse_dynamics<'py>(
        &self,
        py: Python<'py>,
        q: Rows<'py>,
        qd: Rows<'py>,
        qdd: Rows<'py>,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let body = self.body()?;
        let joints = body.joints.len();
        for (name, rows) in [("q", &q), ("qd", &qd), ("qdd", &qdd)] {
            check(name, rows, joints, q.shape())?;
        }
        let motion = [as_rows(&q)?, as_rows(&qd)?, as_rows(&qdd)?];
        let torques = (0..motion[0].nrows()).flat_map(|k| {
            let [q, qd, qdd] = motion.map(|of| of.row(k).to_vec());
            body.torques(&q, &qd, &qdd)
        });
        shaped(py, torques.collect(), q.shape())
    }

    /// The columns of a log, joint by joint: position, command and reference.
    fn columns(&self) -> Vec<[String; 3]> {
        match &self.file {
            ModelFile::Robot(file) => of_robot(file),
            ModelFile::Arm(file) => {
                (1..).zip(&file.joints).map(|(n, j)| arm_log::columns(n, j)).collect()
            }
        }
    }
}

fn of_robot(file: &RobotFile) -> Vec<[String; 3]> {
    let numbers = match &file.pendulum {
        Some(pendulum) if file.base.is_none() => vec![pendulum.joint],
        _ => vec![1, 2, 3],
    };
    let of_joint = |n: u8| [format!("q{n}_rad"), format!("u{n}_V"), format!("qref{n}_rad")];
    numbers.into_iter().map(of_joint).collect()
}
