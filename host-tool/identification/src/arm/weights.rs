//! The weight of each joint's rows: one over the variance of what the fit leaves.

use nalgebra::{DMatrix, DVector};
use signal::estimation::autocorrelation::effective_samples;

use super::condensed::Condensed;
use super::layout::Layout;
use super::rows::JointRows;
use super::settings::Settings;

/// Weights by which rows of all joints have residuals of variance one and count as many as are
/// independent.
#[derive(Clone, Debug, PartialEq)]
pub struct Weighting {
    /// Weight per joint, 0 of one without rows [1 / unit of the command squared].
    pub weights: Vec<f64>,
}

/// Iterates weighted least squares without regard to what is physical.
pub fn weighting(
    rows: &[JointRows],
    condensed: &Condensed,
    layout: Layout,
    settings: &Settings,
) -> Weighting {
    let mut found = weighed(rows, &vec![0.0; layout.all()], layout);
    for _ in 0..settings.weighting_passes {
        let Some(numbers) = solved(&condensed.weighted(&found.weights)) else { break };
        found = weighed(rows, &numbers, layout);
    }
    found
}

/// What the numbers leave of each row's command.
pub fn residuals(rows: &JointRows, numbers: &[f64], layout: Layout) -> Vec<f64> {
    let own = DVector::from_vec(layout.row_numbers(rows.joint, numbers));
    let explained = &rows.rows * own;
    rows.command.iter().zip(explained.iter()).map(|(u, model)| u - model).collect()
}

fn weighed(rows: &[JointRows], numbers: &[f64], layout: Layout) -> Weighting {
    let mut weights = Vec::new();
    for joint in 0..layout.joints {
        let (mut squares, mut count, mut independent) = (0.0, 0.0, 0.0);
        for of_joint in rows.iter().filter(|rows| rows.joint == joint && rows.rows.nrows() > 0) {
            let left = residuals(of_joint, numbers, layout);
            squares += left.iter().map(|r| r * r).sum::<f64>();
            count += left.len() as f64;
            independent += effective_samples(&left);
        }
        let variance = squares / f64::max(count, 1.0);
        // A log without any noise would weigh infinitely.
        let floor =
            1e-18 * rows.iter().flat_map(|r| &r.command).map(|u| u * u).fold(1e-12, f64::max);
        let variance = variance.max(floor);
        let share = if count > 0.0 { (independent / count).min(1.0) } else { 0.0 };
        weights.push(share / variance);
    }
    Weighting { weights }
}

/// Least squares with as little damping as rounding asks, columns scaled to one.
fn solved(rows: &DMatrix<f64>) -> Option<Vec<f64>> {
    const DAMPING: f64 = 1e-10;
    let count = rows.ncols() - 1;
    let scale: Vec<f64> = (0..count).map(|k| rows.column(k).norm().max(1e-300)).collect();
    let mut columns = rows.columns(0, count).into_owned();
    for (mut column, scale) in columns.column_iter_mut().zip(&scale) {
        column /= *scale;
    }
    let mut gram = columns.tr_mul(&columns);
    (0..count).for_each(|k| gram[(k, k)] += DAMPING);
    let found = gram.cholesky()?.solve(&columns.tr_mul(&rows.column(count)));
    Some(found.iter().zip(&scale).map(|(x, scale)| x / scale).collect())
}
