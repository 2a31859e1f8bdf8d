//! By how much a stream is before another that shows the same signal.

use super::align::held;

/// A lag that was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lag {
    /// Time by which the copy is later [s].
    pub(super) seconds: f64,
    /// What nothing tells apart, to either side [s].
    pub(super) doubt_s: f64,
    /// Correlation of the two there.
    pub(super) correlation: f64,
}

/// Samples of the copy that are compared at most, spread over all of it.
const MOST_SAMPLES: usize = 4000;
/// Steps to either side of a search at most.
const MOST_STEPS: f64 = 20_000.0;
/// Steps to either side once it is fine.
const FINE_STEPS: i32 = 20;

/// The lag within `range_s` around `centre_s` at which the signal, held, and its copy agree best, sign,
/// scale and offset apart, first in steps of `step_s`, then a hundred times finer. `None` where one of
/// them stands still.
pub(super) fn lag(
    signal: (&[f64], &[f64]),
    copy: (&[f64], &[f64]),
    centre_s: f64,
    range_s: f64,
    step_s: f64,
) -> Option<Lag> {
    let stride = copy.0.len().div_ceil(MOST_SAMPLES).max(1);
    let (times, values): (Vec<f64>, Vec<f64>) =
        copy.0.iter().zip(copy.1).step_by(stride).map(|(t, v)| (*t, *v)).unzip();
    let at = |seconds: f64| {
        let shifted: Vec<f64> =
            times.iter().map(|t| held(signal.0, signal.1, t - seconds)).collect();
        Lag { seconds, doubt_s: 0.0, correlation: correlation(&shifted, &values) }
    };
    let steps = (range_s / step_s).ceil().clamp(1.0, MOST_STEPS) as i32;
    let mut best = best_of(&at, at(centre_s), steps, step_s);
    for part in [10.0, 100.0] {
        best = best_of(&at, best, FINE_STEPS, step_s / part);
    }
    (best.correlation != 0.0).then(|| middle_of_best(best, step_s / 100.0, at))
}

/// The best of as many steps to either side.
fn best_of(at: &impl Fn(f64) -> Lag, middle: Lag, steps: i32, step_s: f64) -> Lag {
    let tried = (-steps..=steps).map(|k| at(middle.seconds + f64::from(k) * step_s));
    tried.fold(middle, |best, found| {
        let is_better = found.correlation.abs() > best.correlation.abs() + 1e-12;
        if is_better { found } else { best }
    })
}

/// A held signal agrees as well over a whole range of lags: its middle.
fn middle_of_best(best: Lag, step_s: f64, at: impl Fn(f64) -> Lag) -> Lag {
    const REACH: i32 = 200;
    let as_good = |seconds: f64| at(seconds).correlation.abs() >= best.correlation.abs() - 1e-9;
    let reach = |sign: f64| {
        let steps = (1..=REACH).map(|k| best.seconds + sign * f64::from(k) * step_s);
        steps.take_while(|seconds| as_good(*seconds)).last().unwrap_or(best.seconds)
    };
    let (last, first) = (reach(1.0), reach(-1.0));
    Lag { seconds: (last + first) / 2.0, doubt_s: (last - first) / 2.0 + step_s, ..best }
}

/// Correlation where both are numbers; 0 where one does not vary or less than half overlaps.
fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let pairs: Vec<(f64, f64)> =
        a.iter().copied().zip(b.iter().copied()).filter(|(a, b)| (a + b).is_finite()).collect();
    if 2 * pairs.len() < a.len() || pairs.len() < 3 {
        return 0.0;
    }
    let n = pairs.len() as f64;
    let (mean_a, mean_b) =
        (pairs.iter().map(|p| p.0).sum::<f64>() / n, pairs.iter().map(|p| p.1).sum::<f64>() / n);
    let (mut aa, mut bb, mut ab) = (0.0, 0.0, 0.0);
    for (a, b) in pairs {
        let (a, b) = (a - mean_a, b - mean_b);
        (aa, bb, ab) = (aa + a * a, bb + b * b, ab + a * b);
    }
    if aa > 0.0 && bb > 0.0 { ab / (aa * bb).sqrt() } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(t: f64) -> f64 {
        (3.0 * t).sin() + 0.5 * (11.0 * t).cos()
    }

    #[test]
    fn a_lag_is_found_to_a_fraction_of_the_copys_sample() {
        let sent_s: Vec<f64> = (0..5000).map(|k| f64::from(k) * 0.002).collect();
        let sent: Vec<f64> = sent_s.iter().map(|t| wave(*t)).collect();
        let seen_s: Vec<f64> = (0..900).map(|k| 0.5 + f64::from(k) * 0.01).collect();
        let seen: Vec<f64> = seen_s.iter().map(|t| 7.0 - 2.0 * wave(t - 0.0307)).collect();
        let lag = lag((&sent_s, &sent), (&seen_s, &seen), 0.0, 0.5, 0.01).unwrap();
        // Held, the signal is later by half its period, and nothing tells times within one apart.
        assert!((lag.seconds - 0.0307 + 0.001).abs() < 1e-3, "{lag:?}");
        assert!(lag.correlation < -0.999);
    }

    #[test]
    fn what_stands_still_tells_nothing() {
        let times: Vec<f64> = (0..100).map(f64::from).collect();
        assert_eq!(lag((&times, &[1.0; 100]), (&times, &[2.0; 100]), 0.0, 10.0, 0.5), None);
    }
}
