//! Scales, ranges and numbers of an axis.

/// How an axis is scaled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Axis {
    /// In equal steps.
    #[default]
    Linear,
    /// In decades.
    Logarithmic,
}

/// The smallest and the largest of the values.
pub(super) fn bounds(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
}

/// The bounds with a margin of a share of their distance.
pub(super) fn padded((low, high): (f64, f64), axis: Axis, share: f64) -> (f64, f64) {
    match axis {
        Axis::Logarithmic if low < high => (low, high * (1.0 + share)),
        Axis::Logarithmic => (low * 0.5, high * 2.0),
        Axis::Linear => {
            let range = if high > low { high - low } else { low.abs().max(1e-9) };
            let pad = if high > low { share * range } else { 0.5 * range };
            (low - pad, high + pad)
        }
    }
}

/// A number for an axis: no more digits than the eye wants.
pub(super) fn short(value: f64) -> String {
    let size = value.abs();
    if size < 1e-12 {
        "0".into()
    } else if !(1e-3..1e5).contains(&size) {
        format!("{value:.0e}")
    } else {
        let text = format!("{value:.4}");
        text.trim_end_matches('0').trim_end_matches('.').into()
    }
}
