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

/// Adds the products of a matrix' columns over some of its rows, A^T A, by the matrix product of a library that takes
/// what the processor has.
fn add_products(sum: &mut DMatrix<f64>, matrix: &DMatrix<f64>, rows: &Range<usize>) {
    let (count, columns) = (rows.len(), matrix.ncols());
    if count == 0 || columns == 0 {
        return;
    }
    let stride = matrix.nrows();
    let from = &matrix.as_slice()[rows.start..];
    let by_rows: MatrixView<'_, f64, Dyn, Dyn, U1, Dyn> =
        MatrixView::from_slice_with_strides_generic(
            from,
            Dyn(count),
            Dyn(columns),
            U1,
            Dyn(stride),
        );
    let by_columns: MatrixView<'_, f64, Dyn, Dyn, Dyn, U1> =
        MatrixView::from_slice_with_strides_generic(
            from,
            Dyn(columns),
            Dyn(count),
            Dyn(stride),
            U1,
        );
    sum.gemm(1.0, &by_columns, &by_rows, 1.0);
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
