//! The play operator of hysteresis: what hangs on a signal with a gap between.

/// A signal that follows another within a play of `half_width`: it stands until that pushes it, and so keeps nothing
/// of what wavers less. Its distance from the other is `half_width` at most (Krasnosel'skii, Pokrovskii 1989).
///
/// ```
/// // Noise of a tenth about a rise: nothing of it is left.
/// let wavering = [0.0, 0.1, -0.1, 0.1, 1.0, 0.9, 2.0];
/// assert_eq!(signal::play(&wavering, 0.1), [0.0, 0.0, 0.0, 0.0, 0.9, 0.9, 1.9]);
/// ```
pub fn play(signal: &[f64], half_width: f64) -> Vec<f64> {
    let mut at = signal.first().copied().unwrap_or(0.0);
    let mut follow = |pushed: &f64| {
        at = at.max(pushed - half_width).min(pushed + half_width);
        at
    };
    signal.iter().map(&mut follow).collect()
}
