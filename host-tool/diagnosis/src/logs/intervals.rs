//! Between what acts over the intervals of a log and what is measured at its samples.

/// The mean over the two intervals about each sample, of values that belong to the interval
/// that begins at each sample.
pub fn at_samples(intervals: &[f64]) -> Vec<f64> {
    let at = |k: usize| 0.5 * (intervals[k.saturating_sub(1)] + intervals[k]);
    (0..intervals.len()).map(at).collect()
}
