//! Motions as numpy arrays: one of joints, or rows of them.

use numpy::ndarray::{ArrayView2, Axis};
use numpy::{PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::failure::Error;

/// Positions, velocities or accelerations: an array of n joints, or of m x n.
pub type Rows<'py> = PyReadonlyArrayDyn<'py, f64>;

/// Refuses an array that has not the last length or the shape of another.
pub fn check(name: &str, rows: &Rows, joints: usize, like: &[usize]) -> PyResult<()> {
    let shape = rows.shape();
    let is_motion = matches!(shape.len(), 1 | 2) && shape.last() == Some(&joints);
    if !is_motion {
        let what =
            format!("{name} has the shape {shape:?}, but must be ({joints},) or (m, {joints})");
        return Err(Error::new_err(what));
    }
    match shape == like {
        true => Ok(()),
        false => Err(Error::new_err(format!("{name} has the shape {shape:?}, but q has {like:?}"))),
    }
}

/// An array as rows of joints, without a copy.
pub fn as_rows<'a>(rows: &'a Rows) -> PyResult<ArrayView2<'a, f64>> {
    let view = rows.as_array();
    let view = if view.ndim() == 1 { view.insert_axis(Axis(0)) } else { view };
    view.into_dimensionality().map_err(|error| Error::new_err(error.to_string()))
}

/// Values in the shape of the arrays that they were computed of.
pub fn shaped<'py>(
    py: Python<'py>,
    values: Vec<f64>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    numpy::PyArray1::from_vec(py, values).reshape(shape)
}
