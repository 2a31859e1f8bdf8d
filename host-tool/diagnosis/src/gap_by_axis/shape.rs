//! What shape a fitted function has.

/// Part of the values' square that the best multiple of `shape` explains, 0 to 1, and that
/// multiple.
pub(super) fn explained(values: &[f64], shape: impl Fn(usize) -> f64) -> (f64, f64) {
    let (mut cross, mut power, mut energy) = (0.0, 0.0, 0.0);
    for (k, value) in values.iter().enumerate() {
        let s = shape(k);
        cross += s * value;
        power += s * s;
        energy += value * value;
    }
    if power <= 0.0 || energy <= 0.0 {
        return (0.0, 0.0);
    }
    (cross * cross / (power * energy), cross / power)
}

/// The values less their mean.
pub(super) fn centred(values: &[f64]) -> Vec<f64> {
    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
    values.iter().map(|value| value - mean).collect()
}

/// Largest less smallest, but for the outer two per cent.
pub(super) fn spread(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let last = sorted.len().saturating_sub(1) as f64;
    let at = |level: f64| sorted.get((level * last) as usize).copied().unwrap_or(0.0);
    at(0.98) - at(0.02)
}
