//! Times that jitter more than the samples do: a host stamps late what a board took on time.
//!
//! Which of the two it is, the motion tells. Positions that lie smoother over an even clock than over
//! their stamps were taken by that clock.

use crate::criteria::LogCriteria;

/// The times at which positions were taken, where these are not the times stamped: evened, if the
/// motion of most joints is smoother so.
pub fn evened_where_smoother(
    stamped_s: &[f64],
    period_s: f64,
    angles_rad: &[&[f64]],
    criteria: &LogCriteria,
) -> Option<Vec<f64>> {
    let even_s = evened(stamped_s, period_s, criteria.clock_wander_s);
    let moving = angles_rad.iter().filter(|q_rad| roughness(stamped_s, q_rad) > 0.0);
    let smoother = |q_rad: &&&[f64]| {
        roughness(&even_s, q_rad) < criteria.smoother_part * roughness(stamped_s, q_rad)
    };
    (2 * moving.clone().filter(smoother).count() > moving.count()).then_some(even_s)
}

/// A clock that ticks evenly and wanders as the stamps do, in seconds: each sample comes one period
/// after the one before, or several where samples are missing.
fn evened(stamped_s: &[f64], period_s: f64, wander_s: f64) -> Vec<f64> {
    let ticks = ticks(stamped_s, period_s);
    let (start_s, true_period_s) = line(&ticks, stamped_s);
    let on_line = |tick: &f64| start_s + true_period_s * tick;
    let off_s: Vec<f64> = stamped_s.iter().zip(&ticks).map(|(t, tick)| t - on_line(tick)).collect();
    let wander_s = wander(&off_s, ((wander_s / true_period_s).round() as usize).max(1));
    ticks.iter().zip(&wander_s).map(|(tick, wander)| on_line(tick) + wander).collect()
}

/// Means of blocks of so many values, and lines between their middles.
fn wander(values: &[f64], block: usize) -> Vec<f64> {
    let blocks = (values.len() / block).max(1);
    let length = values.len() as f64 / blocks as f64;
    let edge = |index: usize| (index as f64 * length).round() as usize;
    let mean = |index: usize| {
        let own = &values[edge(index)..edge(index + 1)];
        own.iter().sum::<f64>() / own.len().max(1) as f64
    };
    let means: Vec<f64> = (0..blocks).map(mean).collect();
    let at = |k: usize| {
        let place = ((k as f64 + 0.5) / length - 0.5).clamp(0.0, (blocks - 1) as f64);
        let (before, part) = (place as usize, place.fract());
        let after = (before + 1).min(blocks - 1);
        means[before] + part * (means[after] - means[before])
    };
    (0..values.len()).map(at).collect()
}

/// How many periods each sample comes after the first.
fn ticks(stamped_s: &[f64], period_s: f64) -> Vec<f64> {
    /// What is taken over of a stamp's error: the period that is told is not quite the clock's.
    const FOLLOWED: f64 = 0.05;
    let mut now_s = stamped_s[0];
    let mut ticks = vec![0.0];
    for k in 1..stamped_s.len() {
        let late_s = late_s(&stamped_s[k..], now_s, period_s);
        let passed = 1.0 + (late_s / period_s).round().max(0.0);
        ticks.push(ticks[k - 1] + passed);
        now_s += passed * period_s;
        now_s += FOLLOWED * (stamped_s[k] - now_s);
    }
    ticks
}

/// The line through points by least squares: where it begins, and its slope.
fn line(x: &[f64], y: &[f64]) -> (f64, f64) {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (x_mean, y_mean) = (mean(x), mean(y));
    let product: f64 = x.iter().zip(y).map(|(x, y)| (x - x_mean) * (y - y_mean)).sum();
    let square: f64 = x.iter().map(|x| (x - x_mean).powi(2)).sum();
    let slope = product / square.max(f64::MIN_POSITIVE);
    (y_mean - slope * x_mean, slope)
}

/// By how much the next samples are late [s]: the first, and not only it but most of five.
fn late_s(next_s: &[f64], now_s: f64, period_s: f64) -> f64 {
    let mut late_s: Vec<f64> = next_s
        .iter()
        .take(5)
        .enumerate()
        .map(|(ahead, stamp_s)| stamp_s - now_s - (ahead as f64 + 1.0) * period_s)
        .collect();
    let own_s = late_s[0];
    late_s.sort_unstable_by(f64::total_cmp);
    own_s.min(late_s[late_s.len() / 2])
}

/// How far positions are from the line between their neighbours, rms of the middle half [rad]: what
/// is wrong for a sample does not count.
fn roughness(time_s: &[f64], q_rad: &[f64]) -> f64 {
    let off_rad = |k: usize| {
        let part = (time_s[k] - time_s[k - 1]) / (time_s[k + 1] - time_s[k - 1]);
        (q_rad[k] - q_rad[k - 1] - part * (q_rad[k + 1] - q_rad[k - 1])).abs()
    };
    let mut all: Vec<f64> = (1..q_rad.len().saturating_sub(1)).map(off_rad).collect();
    all.sort_unstable_by(f64::total_cmp);
    all.get(3 * all.len() / 4).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Deviations of a triangle's form, the same each time.
    fn jitter(k: usize) -> f64 {
        3e-4 * (((k * 7919) % 101) as f64 / 50.0 - 1.0)
    }

    fn motion(t: f64) -> f64 {
        (3.0 * t).sin() + 0.3 * (11.0 * t).cos()
    }

    fn worst(found: &[f64], right: &[f64]) -> f64 {
        found.iter().zip(right).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn late_stamps_of_even_samples_are_evened() {
        let even: Vec<f64> = (0..5000).map(|k| 1e-3 * k as f64).collect();
        for every in [5001, 50] {
            let kept: Vec<usize> = (0..5000).filter(|k| k % every != every - 1).collect();
            let taken: Vec<f64> = kept.iter().map(|&k| even[k]).collect();
            let stamped: Vec<f64> = kept.iter().map(|&k| even[k] + jitter(k)).collect();
            let q: Vec<f64> = taken.iter().map(|t| motion(*t)).collect();
            let criteria = LogCriteria::default();
            let found = evened_where_smoother(&stamped, 1e-3, &[&q], &criteria).unwrap();
            let worst_s = worst(&found, &taken);
            assert!(worst_s < 2e-5, "{every}: {worst_s}");
        }
    }

    #[test]
    fn uneven_samples_keep_their_stamps() {
        let stamped: Vec<f64> = (0..5000).map(|k| 1e-3 * k as f64 + jitter(k)).collect();
        let q: Vec<f64> = stamped.iter().map(|t| motion(*t)).collect();
        let criteria = LogCriteria::default();
        assert_eq!(evened_where_smoother(&stamped, 1e-3, &[&q], &criteria), None);
    }
}
