//! Root mean square.

/// Root mean square of a signal; zero for none.
pub fn rms(signal: &[f64]) -> f64 {
    let power: f64 = signal.iter().map(|x| x * x).sum();
    if signal.is_empty() { 0.0 } else { (power / signal.len() as f64).sqrt() }
}
