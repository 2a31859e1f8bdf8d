//! The weight of each joint's rows: one over the variance of what the fit leaves.

use nalgebra::DVector;
use signal::estimation::autocorrelation::effective_samples;

use super::condensed::Condensed;
use super::layout::Layout;
use super::linear::Linear;
use super::rows::JointRows;
use super::settings::Settings;

/// Weights per joint by which its rows have residuals of variance one and count as many as are independent, 0 of one
/// without rows [1 / unit of the command squared]: weighted least squares, again and again, without regard to what is
/// physical.
pub fn weights(
    rows: &[JointRows],
    condensed: &Condensed,
    layout: Layout,
    settings: &Settings,
) -> Vec<f64> {
    let mut found = weighed(rows, &vec![0.0; layout.all()], layout);
    for _ in 0..settings.weighting_passes {
        let Some(solved) = Linear::of(&condensed.weighted(&found)) else { break };
        found = weighed(rows, &solved.numbers, layout);
    }
    found
}

/// What the numbers leave of each row's command.
pub fn residuals(rows: &JointRows, numbers: &[f64], layout: Layout) -> Vec<f64> {
    let own = DVector::from_vec(layout.row_numbers(rows.joint, numbers));
    let explained = &rows.rows * own;
    rows.command.iter().zip(explained.iter()).map(|(u, model)| u - model).collect()
}

fn weighed(rows: &[JointRows], numbers: &[f64], layout: Layout) -> Vec<f64> {
    let of_joint = |joint: usize| {
        let left = left_of(rows, joint, numbers, layout);
        let count: usize = left.iter().map(Vec::len).sum();
        let independent: f64 = left.iter().map(|left| effective_samples(left)).sum();
        let share = if count > 0 { (independent / count as f64).min(1.0) } else { 0.0 };
        share / variance(rows, joint, numbers, layout)
    };
    (0..layout.joints).map(of_joint).collect()
}

/// Mean square of what the numbers leave of a joint's command [its unit squared].
fn variance(rows: &[JointRows], joint: usize, numbers: &[f64], layout: Layout) -> f64 {
    let left = left_of(rows, joint, numbers, layout);
    let count: usize = left.iter().map(Vec::len).sum();
    let squares: f64 = left.iter().flatten().map(|r| r * r).sum();
    // A log without any noise would weigh infinitely.
    let floor = 1e-18 * rows.iter().flat_map(|r| &r.command).map(|u| u * u).fold(1e-12, f64::max);
    (squares / f64::max(count as f64, 1.0)).max(floor)
}

/// What the numbers leave of a joint's command, by rows of one stretch.
pub fn left_of(rows: &[JointRows], joint: usize, numbers: &[f64], layout: Layout) -> Vec<Vec<f64>> {
    let of_joint = rows.iter().filter(|rows| rows.joint == joint && rows.rows.nrows() > 0);
    of_joint.map(|rows| residuals(rows, numbers, layout)).collect()
}
