//! Unevenly sampled signals on an even clock.

use crate::criteria::LogCriteria;

/// Samples at their own times, and the even clock they are brought to.
#[derive(Clone, Debug)]
pub struct EvenClock<'a> {
    time_s: &'a [f64],
    period_s: f64,
    count: usize,
    even: bool,
    /// Samples further apart lack one between them.
    longest_hold_s: f64,
}

impl<'a> EvenClock<'a> {
    /// A clock over strictly increasing times, at least two of them.
    pub fn over(time_s: &'a [f64], typical_period_s: f64, criteria: &LogCriteria) -> Self {
        let span_s = time_s[time_s.len() - 1] - time_s[0];
        let intervals = (span_s / typical_period_s).round().max(1.0);
        // The mean of this stretch: a typical period is rounded, which adds up.
        let period_s = span_s / intervals;
        let count = intervals as usize + 1;
        let offset = |(k, t): (usize, &f64)| (t - time_s[0] - k as f64 * period_s).abs();
        let worst = time_s.iter().enumerate().map(offset).fold(0.0, f64::max);
        let even = count == time_s.len() && worst < criteria.even_part * period_s;
        let longest_hold_s = criteria.missing_sample_periods * period_s;
        Self { time_s, period_s, count, even, longest_hold_s }
    }

    /// The same clock with so many of its periods in one.
    pub fn coarser(&self, every: usize) -> Self {
        let count = (self.count - 1) / every + 1;
        let period_s = every as f64 * self.period_s;
        Self { period_s, count, even: self.even && every == 1, ..*self }
    }

    /// The even period [s].
    pub fn period_s(&self) -> f64 {
        self.period_s
    }

    /// A smooth signal at the clock's instants: cubic pieces between the samples.
    pub fn smooth(&self, signal: &[f64]) -> Vec<f64> {
        if self.even {
            return signal.to_vec();
        }
        self.of_signal_at(self.time_s, signal)
    }

    /// The same of a signal that was sampled at other times [s].
    pub fn of_signal_at(&self, time_s: &[f64], signal: &[f64]) -> Vec<f64> {
        let mut k = 0;
        let at = |index: usize| {
            let t = self.instant(index);
            k = advanced(time_s, k, t);
            cubic(time_s, signal, k, t)
        };
        (0..self.count).map(at).collect()
    }

    /// The mean over each of the clock's intervals of a signal that is held from sample to
    /// sample. Where a sample is missing, what was put out then is not known: it is taken
    /// to lie half way between its neighbours.
    pub fn held_mean(&self, signal: &[f64]) -> Vec<f64> {
        if self.even {
            return signal.to_vec();
        }
        let area = self.areas(signal);
        let mut k = 0;
        let mut before = 0.0;
        let mut mean = |index: usize| {
            let t = self.instant(index + 1);
            k = advanced(self.time_s, k, t);
            let until = area[k] + self.value(signal, k) * (t - self.time_s[k]);
            let mean = (until - before) / self.period_s;
            before = until;
            mean
        };
        (0..self.count).map(&mut mean).collect()
    }

    /// Time of one of its instants [s].
    pub fn instant(&self, index: usize) -> f64 {
        self.time_s[0] + index as f64 * self.period_s
    }

    /// What acts on average between sample k and the next.
    fn value(&self, signal: &[f64], k: usize) -> f64 {
        let gap = self.time_s[k + 1] - self.time_s[k];
        if gap > self.longest_hold_s { 0.5 * (signal[k] + signal[k + 1]) } else { signal[k] }
    }

    /// Integral from the first sample to each.
    fn areas(&self, signal: &[f64]) -> Vec<f64> {
        let mut area = vec![0.0];
        for k in 0..self.time_s.len() - 1 {
            let step = self.value(signal, k) * (self.time_s[k + 1] - self.time_s[k]);
            area.push(area[k] + step);
        }
        area
    }
}

/// The last sample not after `t`, from `k` on, the last one excluded.
fn advanced(time_s: &[f64], mut k: usize, t: f64) -> usize {
    while k + 2 < time_s.len() && time_s[k + 1] <= t {
        k += 1;
    }
    k
}

/// Cubic Hermite interpolation between samples k and k + 1.
fn cubic(time_s: &[f64], signal: &[f64], k: usize, t: f64) -> f64 {
    let h = time_s[k + 1] - time_s[k];
    let x = ((t - time_s[k]) / h).clamp(0.0, 1.0);
    let (a, b) = (signal[k], signal[k + 1]);
    let (da, db) = (h * slope(time_s, signal, k), h * slope(time_s, signal, k + 1));
    let x2 = x * x;
    let x3 = x2 * x;
    a + da * x + (3.0 * (b - a) - 2.0 * da - db) * x2 + (2.0 * (a - b) + da + db) * x3
}

/// Slope at a sample of the parabola through it and its neighbours, which near a gap follows the side
/// without it.
fn slope(time_s: &[f64], signal: &[f64], k: usize) -> f64 {
    let rise = |k: usize| (signal[k + 1] - signal[k]) / (time_s[k + 1] - time_s[k]);
    if k == 0 || k + 1 == signal.len() {
        return rise(k.saturating_sub(1));
    }
    let (before, after) = (time_s[k] - time_s[k - 1], time_s[k + 1] - time_s[k]);
    (rise(k - 1) * after + rise(k) * before) / (before + after)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_samples_of_a_swing_are_filled() {
        let at = |k: u32| f64::from(k) * 1e-3;
        let all: Vec<f64> = (0..2000).map(at).collect();
        let some: Vec<f64> = (0..2000).filter(|k| k % 10 != 7).map(at).collect();
        let swing = |t: &f64| (6.0 * t).sin();
        let clock = EvenClock::over(&some, 1e-3, &LogCriteria::default());
        let filled = clock.smooth(&some.iter().map(swing).collect::<Vec<_>>());
        let error = all.iter().zip(&filled).map(|(t, q)| (swing(t) - q).abs()).fold(0.0, f64::max);
        assert!(filled.len() == 2000 && error < 1e-5, "{error:e}");
    }

    #[test]
    fn a_held_command_keeps_its_area() {
        let times = [0.0, 0.0008, 0.002, 0.0031, 0.004, 0.005];
        let clock = EvenClock::over(&times, 1e-3, &LogCriteria::default());
        let mean = clock.held_mean(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        assert!((mean[0] - 1.2).abs() < 1e-12 && (mean[1] - 2.0).abs() < 1e-12, "{mean:?}");
    }
}
