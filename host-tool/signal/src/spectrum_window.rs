//! Windows and trends of a spectrum's segments.

use std::f64::consts::TAU;

/// Hann's window, periodic, as spectra want it.
pub fn hann(length: usize) -> Vec<f64> {
    (0..length).map(|k| 0.5 - 0.5 * (TAU * k as f64 / length as f64).cos()).collect()
}

/// A piece of a signal less its mean, and less its least-squares line with `trend`.
pub fn without_trend(piece: &[f64], trend: bool) -> Vec<f64> {
    let mean = mean(piece);
    let slope = if trend { slope_per_sample(piece) } else { 0.0 };
    let middle = 0.5 * (piece.len() as f64 - 1.0);
    let line = |k: usize| mean + slope * (k as f64 - middle);
    piece.iter().enumerate().map(|(k, x)| x - line(k)).collect()
}

/// Arithmetic mean; zero of nothing.
pub fn mean(signal: &[f64]) -> f64 {
    signal.iter().sum::<f64>() / signal.len().max(1) as f64
}

/// Slope of the least-squares line through a signal, per sample; zero below two samples.
pub fn slope_per_sample(signal: &[f64]) -> f64 {
    let count = signal.len() as f64;
    let middle = 0.5 * (count - 1.0);
    let first: f64 = signal.iter().enumerate().map(|(k, x)| (k as f64 - middle) * x).sum();
    let second = count * (count * count - 1.0) / 12.0;
    if second > 0.0 { first / second } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_line_leaves_nothing() {
        let line: Vec<f64> = (0..64).map(|k| 3.0 - 0.25 * f64::from(k)).collect();
        assert!((slope_per_sample(&line) + 0.25).abs() < 1e-12);
        assert!(without_trend(&line, true).iter().all(|x| x.abs() < 1e-12));
        assert!((without_trend(&line, false)[0] - 7.875).abs() < 1e-12);
    }
}
