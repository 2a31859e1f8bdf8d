//! Slopes of one joint's rows along what is open in a model.

use nalgebra::DMatrix;

/// A column of rows of one joint, with its place among what is open.
pub(super) type Column = (usize, Vec<f64>);

/// Slopes of one joint's rows.
#[derive(Clone)]
pub struct JointSlopes {
    /// Which joint.
    pub joint: usize,
    /// Places of the columns among what is open.
    pub places: Vec<usize>,
    /// Rows by columns.
    pub matrix: DMatrix<f64>,
}

impl JointSlopes {
    /// The same with every row scaled.
    pub fn scaled(&self, ratios: &[f64]) -> Self {
        let mut scaled = self.clone();
        for mut column in scaled.matrix.column_iter_mut() {
            column.iter_mut().zip(ratios).for_each(|(slope, ratio)| *slope *= ratio);
        }
        scaled
    }

    /// Of columns of so many rows, with their places among what is open.
    pub(super) fn of(joint: usize, columns: &[Column], count: usize) -> Self {
        let flat = columns.iter().flat_map(|(_, rows)| rows.iter().copied());
        let matrix = DMatrix::from_iterator(count, columns.len(), flat);
        Self { joint, places: columns.iter().map(|(place, _)| *place).collect(), matrix }
    }
}
