//! Least squares judged on stretches that are left out.

use nalgebra::{DMatrix, DVector};

/// Regressor rows with few entries each.
#[derive(Clone, Debug, Default)]
pub(super) struct Design {
    columns: usize,
    ends: Vec<usize>,
    entries: Vec<(usize, f64)>,
}

impl Design {
    /// Rows 0 to `rows`, whose entries (column, value) `fill` appends.
    pub fn of(rows: usize, columns: usize, fill: impl Fn(usize, &mut Vec<(usize, f64)>)) -> Self {
        let mut design = Self { columns, ..Self::default() };
        for row in 0..rows {
            fill(row, &mut design.entries);
            design.ends.push(design.entries.len());
        }
        design
    }

    fn rows(&self) -> impl Iterator<Item = &[(usize, f64)]> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, &end)| &self.entries[start..end])
    }

    /// The function with these coefficients at every row.
    pub fn times(&self, coefficients: &DVector<f64>) -> Vec<f64> {
        let value = |row: &[(usize, f64)]| row.iter().map(|(c, x)| x * coefficients[*c]).sum();
        self.rows().map(value).collect()
    }
}

/// Normal equations of a target, fold by fold.
#[derive(Clone, Debug)]
pub(super) struct Fit {
    folds: Vec<(DMatrix<f64>, DVector<f64>)>,
}

impl Fit {
    /// The sums of each fold; `fold` numbers that of every row from 0.
    pub fn of(design: &Design, target: &[f64], fold: &[usize]) -> Self {
        let count = fold.iter().max().map_or(0, |most| most + 1);
        let n = design.columns;
        let mut folds = vec![(DMatrix::zeros(n, n), DVector::zeros(n)); count];
        for ((row, &y), &fold) in design.rows().zip(target).zip(fold) {
            let (normal, right) = &mut folds[fold];
            for &(a, x) in row {
                right[a] += x * y;
                for &(b, z) in row {
                    normal[(a, b)] += x * z;
                }
            }
        }
        Self { folds }
    }

    /// What columns `all` take off the squares of left-out folds beyond what `base` takes off;
    /// 0 where most folds do not agree that it is something.
    pub fn gain(&self, base: &[usize], all: &[usize]) -> f64 {
        let (before, after) = (self.gains(base), self.gains(all));
        let extra: Vec<f64> = after.iter().zip(&before).map(|(a, b)| a - b).collect();
        let agreeing = extra.iter().filter(|&&gain| gain > 0.0).count();
        let asked = extra.iter().filter(|&&gain| gain != 0.0).count();
        let total: f64 = extra.iter().sum();
        if 4 * agreeing >= 3 * asked { total.max(0.0) } else { 0.0 }
    }

    /// What these columns take off the squares of each fold when fitted to the others.
    fn gains(&self, columns: &[usize]) -> Vec<f64> {
        let (normal, right) = self.total();
        let of_fold = |(a, b): &(DMatrix<f64>, DVector<f64>)| {
            let weights = solve(&(&normal - a), &(&right - b), columns);
            2.0 * weights.dot(b) - (a * &weights).dot(&weights)
        };
        self.folds.iter().map(of_fold).collect()
    }

    /// Coefficients of these columns from all folds; the others are 0.
    pub fn coefficients(&self, columns: &[usize]) -> DVector<f64> {
        let (normal, right) = self.total();
        solve(&normal, &right, columns)
    }

    fn total(&self) -> (DMatrix<f64>, DVector<f64>) {
        let n = self.folds.first().map_or(0, |fold| fold.1.len());
        let zero = (DMatrix::zeros(n, n), DVector::zeros(n));
        self.folds.iter().fold(zero, |sum, fold| (sum.0 + &fold.0, sum.1 + &fold.1))
    }
}

/// Least squares over some of the columns, a little drawn towards zero.
fn solve(normal: &DMatrix<f64>, right: &DVector<f64>, columns: &[usize]) -> DVector<f64> {
    const RIDGE: f64 = 1e-3;
    let mut solution = DVector::zeros(right.len());
    let mut small =
        DMatrix::from_fn(columns.len(), columns.len(), |r, c| normal[(columns[r], columns[c])]);
    let ridge = RIDGE * small.trace() / columns.len().max(1) as f64;
    (0..columns.len()).for_each(|k| small[(k, k)] += ridge);
    let target = DVector::from_fn(columns.len(), |r, _| right[columns[r]]);
    if let Some(factors) = small.cholesky() {
        let weights = factors.solve(&target);
        columns.iter().zip(weights.iter()).for_each(|(&column, &w)| solution[column] = w);
    }
    solution
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_column_without_meaning_gains_nothing() {
        let rows = 1000;
        let fold: Vec<usize> = (0..rows).map(|k| k / 50 % 5).collect();
        let design = Design::of(rows, 2, |k, row| {
            row.push((0, (k as f64 * 0.7).sin()));
            row.push((1, (k as f64 * 0.31).cos()));
        });
        let target: Vec<f64> = (0..rows).map(|k| 0.5 * (k as f64 * 0.7).sin()).collect();
        let fit = Fit::of(&design, &target, &fold);
        let energy: f64 = target.iter().map(|y| y * y).sum();
        assert!((fit.gain(&[], &[0]) / energy - 1.0).abs() < 1e-3);
        assert!(fit.gain(&[0], &[0, 1]) < 1e-3 * energy);
        assert!((fit.coefficients(&[0, 1])[0] - 0.5).abs() < 1e-3);
    }
}
