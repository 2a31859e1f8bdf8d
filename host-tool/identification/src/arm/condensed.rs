//! All rows of a joint as few that say the same: the triangular factor of (rows, command).

use nalgebra::DMatrix;

use super::layout::{Layout, OWN};
use super::rows::JointRows;

/// Per joint the factor R of (rows | command), whose products have the same squares.
#[derive(Clone, Debug, PartialEq)]
pub struct Condensed {
    layout: Layout,
    factors: Vec<DMatrix<f64>>,
}

impl Condensed {
    /// Of the rows of all logs; a joint without rows says nothing.
    pub fn of(rows: &[JointRows], layout: Layout) -> Self {
        let mut factors = vec![DMatrix::zeros(0, layout.of_row() + 1); layout.joints];
        for of_joint in rows {
            let factor = &mut factors[of_joint.joint];
            *factor = with_rows(factor, of_joint);
        }
        Self { layout, factors }
    }

    /// The rows of all joints, each multiplied by the root of its weight, over all numbers of the
    /// layout and the command: at most as many rows as columns.
    pub fn weighted(&self, weights: &[f64]) -> DMatrix<f64> {
        let blocks: Vec<_> = self.factors.iter().zip(weights).enumerate().collect();
        let count = blocks.iter().map(|(_, (factor, _))| factor.nrows()).sum();
        let mut all = DMatrix::zeros(count, self.layout.all() + 1);
        let mut first = 0;
        for (joint, (factor, weight)) in blocks {
            let (rows, links) = (factor.nrows(), self.layout.links());
            let scaled = factor * weight.sqrt();
            let own = self.layout.own(joint);
            all.view_mut((first, 0), (rows, links)).copy_from(&scaled.columns(0, links));
            all.view_mut((first, own), (rows, OWN)).copy_from(&scaled.columns(links, OWN));
            all.column_mut(self.layout.all())
                .rows_mut(first, rows)
                .copy_from(&scaled.column(links + OWN));
            first += rows;
        }
        triangular(all)
    }
}

fn with_rows(factor: &DMatrix<f64>, added: &JointRows) -> DMatrix<f64> {
    let (before, width) = factor.shape();
    let count = added.rows.nrows();
    let mut all = DMatrix::zeros(before + count, width);
    all.rows_mut(0, before).copy_from(factor);
    all.view_mut((before, 0), (count, width - 1)).copy_from(&added.rows);
    all.column_mut(width - 1).rows_mut(before, count).copy_from_slice(&added.command);
    triangular(all)
}

fn triangular(matrix: DMatrix<f64>) -> DMatrix<f64> {
    if matrix.nrows() > matrix.ncols() { matrix.qr().r() } else { matrix }
}
