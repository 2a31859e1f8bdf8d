//! Products of the slopes with each other: the curvature of the squares, in all and by groups of rows.

use std::ops::Range;

use nalgebra::{DMatrix, Dyn, MatrixView, U1};
use rayon::prelude::*;

use super::joint_slopes::JointSlopes;

/// Rows of a joint that lie side by side in one group of rows.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Run {
    /// Which rows.
    pub rows: Range<usize>,
    /// The group that they belong to.
    pub group: usize,
}

/// The runs of rows that belong to these groups.
pub(super) fn runs(group_of: &[usize]) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    for (k, &group) in group_of.iter().enumerate() {
        match runs.last_mut() {
            Some(run) if run.group == group => run.rows.end = k + 1,
            _ => runs.push(Run { rows: k..k + 1, group }),
        }
    }
    runs
}

/// Products of the slopes over the train rows of each group, `open` by `open`; the runs of every joint in the order of
/// `joints`.
pub(super) fn by_groups(
    joints: &[JointSlopes],
    runs: &[Vec<Run>],
    groups: usize,
    open: usize,
) -> Vec<DMatrix<f64>> {
    let of_joint = |(slopes, runs): (&JointSlopes, &Vec<Run>)| of_joint(slopes, runs, groups);
    let of_joints: Vec<Vec<DMatrix<f64>>> = joints.par_iter().zip(runs).map(of_joint).collect();
    let mut sums = vec![DMatrix::zeros(open, open); groups];
    for (slopes, own) in joints.iter().zip(&of_joints) {
        sums.iter_mut().zip(own).for_each(|(sum, own)| scatter(sum, own, &slopes.places));
    }
    sums
}

/// The same of one joint, by its own columns.
fn of_joint(slopes: &JointSlopes, runs: &[Run], groups: usize) -> Vec<DMatrix<f64>> {
    let columns = slopes.places.len();
    let mut own = vec![DMatrix::zeros(columns, columns); groups];
    for run in runs {
        add_products(&mut own[run.group], &slopes.matrix, &run.rows);
    }
    own
}

/// Adds the products of a matrix' columns over some of its rows, A^T A.
fn add_products(sum: &mut DMatrix<f64>, matrix: &DMatrix<f64>, rows: &Range<usize>) {
    let right = matrix.rows_range(rows.clone());
    match is_large([matrix.ncols(), rows.len(), matrix.ncols()]) {
        true => sum.gemm(1.0, &turned(matrix, rows), &right, 1.0),
        false => *sum += right.tr_mul(&right),
    }
}

/// Products A^T B of the columns of two matrices, over the first rows of the first where the second has fewer.
pub(super) fn products_of(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    let rows = 0..b.nrows();
    match is_large([a.ncols(), rows.len(), b.ncols()]) {
        true => turned(a, &rows) * b,
        false => a.rows_range(rows).tr_mul(b),
    }
}

/// Whether a product with a [`turned`] matrix may be taken, by its dimensions: nalgebra 0.34.2 multiplies matrices of up
/// to five rows or columns by a routine that, where there is a stride from row to row, goes on beyond the end of both
/// (`axcpy_uninit` takes the length of the slice behind a column for that of the column).
fn is_large(dimensions: [usize; 3]) -> bool {
    const SAFE: usize = 8;
    dimensions.iter().all(|&dimension| dimension >= SAFE)
}

/// Some rows of a matrix as columns, without a copy: its product is that of a library that takes what the processor has.
fn turned<'a>(
    matrix: &'a DMatrix<f64>,
    rows: &Range<usize>,
) -> MatrixView<'a, f64, Dyn, Dyn, Dyn, U1> {
    let (shape, strides) = ((Dyn(matrix.ncols()), Dyn(rows.len())), (Dyn(matrix.nrows()), U1));
    let from = &matrix.as_slice()[rows.start..];
    MatrixView::from_slice_with_strides_generic(from, shape.0, shape.1, strides.0, strides.1)
}

/// Adds products of a joint's columns where these are among all that is open.
fn scatter(sum: &mut DMatrix<f64>, own: &DMatrix<f64>, places: &[usize]) {
    for (b, &place_b) in places.iter().enumerate() {
        for (a, &place_a) in places.iter().enumerate() {
            sum[(place_a, place_b)] += own[(a, b)];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_of_small_and_large_matrices_are_those_of_their_columns() {
        for [columns, rows, fewer, others] in
            [[40, 70, 60, 20], [40, 70, 60, 2], [40, 70, 3, 20], [4, 70, 60, 20], [40, 70, 0, 20]]
        {
            let a = DMatrix::from_fn(rows, columns, |row, k| ((row * 5 + k) as f64).sin());
            let b = DMatrix::from_fn(fewer, others, |row, k| ((row * 3 + k) as f64).cos());
            let wanted = a.rows_range(..fewer).tr_mul(&b);
            assert!((products_of(&a, &b) - wanted).amax() < 1e-12, "{columns} {fewer} {others}");
            let (mut sum, some) = (DMatrix::zeros(columns, columns), 1..1 + fewer);
            add_products(&mut sum, &a, &some);
            let own = a.rows_range(some);
            assert!((sum - own.tr_mul(&own)).amax() < 1e-12, "{columns} {fewer}");
        }
    }

    #[test]
    fn products_of_groups_are_those_of_their_rows() {
        let matrix = DMatrix::from_fn(90, 7, |row, column| ((row * 7 + 3 * column) as f64).sin());
        let slopes = JointSlopes { joint: 0, places: vec![2, 0, 1, 4, 5, 6, 7], matrix };
        let group_of: Vec<usize> = (0..80).map(|k| k / 9 % 3).collect();
        let sums = by_groups(std::slice::from_ref(&slopes), &[runs(&group_of)], 3, 8);
        for (group, sum) in sums.iter().enumerate() {
            let rows: Vec<usize> = (0..80).filter(|&k| group_of[k] == group).collect();
            let own = slopes.matrix.select_rows(&rows);
            let products = own.tr_mul(&own);
            let mut wanted = DMatrix::zeros(8, 8);
            scatter(&mut wanted, &products, &slopes.places);
            assert!((sum - wanted).amax() < 1e-12, "group {group}");
        }
    }
}
