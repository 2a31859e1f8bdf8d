//! What an effect takes of the logs that chose nothing, with intervals.

use rand_distr::{Distribution, Uniform};
use rand_pcg::Pcg64Mcg;

use crate::fit::errors;
use crate::joint::ServoJoint;
use crate::judged::Judged;
use crate::settings::Settings;

/// Squares of some seconds of a log.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// Which log it is of.
    pub log: usize,
    /// Sum of squares [rad^2].
    pub squares: f64,
    /// Rows that count.
    pub rows: usize,
}

/// How long errors are taken as one when data sets are drawn again [s].
const UNIT_S: f64 = 20.0;

/// Squares of all logs by units of 20 s.
pub fn units(servo: &ServoJoint, joint: usize, logs: &[&Judged], step_s: f64) -> Vec<Unit> {
    let of = |(k, log): (usize, &&Judged)| cut(&errors(servo, log, joint, step_s), joint, log, k);
    logs.iter().enumerate().flat_map(of).collect()
}

/// A log's errors by units.
pub fn cut(errors: &[f64], joint: usize, log: &Judged, number: usize) -> Vec<Unit> {
    let begin = log.record.time_s[0];
    let mut found: Vec<Unit> = Vec::new();
    for (row, error) in errors.iter().enumerate() {
        let index = ((log.record.time_s[row] - begin) / UNIT_S) as usize;
        if found.len() <= index {
            found.resize(index + 1, Unit { log: number, squares: 0.0, rows: 0 });
        }
        if log.counts[joint][row] {
            found[index].squares += error * error;
            found[index].rows += 1;
        }
    }
    found
}

/// Squares of all units [rad^2].
pub fn squares(units: &[Unit]) -> f64 {
    units.iter().map(|unit| unit.squares).sum()
}

/// The rms over units [rad].
pub fn rms(units: &[Unit]) -> f64 {
    let rows: usize = units.iter().map(|unit| unit.rows).sum();
    (squares(units) / rows.max(1) as f64).sqrt()
}

/// What an effect takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taken {
    /// Part of the squares above the noise that goes with the effect.
    pub share: f64,
    /// Its 95 % interval.
    pub share_interval: [f64; 2],
    /// 1 - rms with the effect / rms without.
    pub shrinkage: f64,
    /// Its 95 % interval.
    pub shrinkage_interval: [f64; 2],
    /// Shrinkage in each half of the logs.
    pub halves: [f64; 2],
    /// Mean of the share by its deviation.
    pub certainty: f64,
}

impl Taken {
    /// From units without any effect, without this one, and with it; `noise` is a row's square.
    pub fn of(
        base: &[Unit],
        without: &[Unit],
        with: &[Unit],
        noise: f64,
        settings: &Settings,
    ) -> Self {
        let all: Vec<usize> = (0..base.len()).collect();
        let at = |chosen: &[usize]| {
            let sum = |units: &[Unit]| chosen.iter().map(|k| units[*k].squares).sum::<f64>();
            let rows: usize = chosen.iter().map(|k| base[*k].rows).sum();
            let above = (sum(base) - noise * rows as f64).max(1e-3 * sum(base)).max(1e-18);
            let (less, more) = (sum(with), sum(without).max(1e-18));
            // A refit without one of several effects may leave more than there was without any.
            (((more - less) / above).min(1.0), 1.0 - (less / more).sqrt())
        };
        let (share, shrinkage) = at(&all);
        let drawn = resampled(base.len(), settings.resamples).map(|chosen| at(&chosen));
        let (mut shares, mut shrinkages): (Vec<f64>, Vec<f64>) = drawn.unzip();
        let spread = deviation(&shares);
        let half = |side: usize| {
            // Half of the logs; of the units where there is one log.
            let one = base.iter().all(|unit| unit.log == base[0].log);
            let of = |k: &usize| {
                if one { (2 * k / base.len().max(1)) == side } else { base[*k].log % 2 == side }
            };
            at(&all.iter().copied().filter(of).collect::<Vec<_>>()).1
        };
        Self {
            share,
            share_interval: interval(&mut shares),
            shrinkage,
            shrinkage_interval: interval(&mut shrinkages),
            halves: [half(0), half(1)],
            certainty: share / spread.max(1e-9),
        }
    }

    /// Whether the effect may be named.
    pub fn is_confirmed(&self, settings: &Settings) -> bool {
        let halves = self.halves.iter().all(|half| *half >= settings.least_half_shrinkage);
        self.shrinkage >= settings.least_shrinkage && self.shrinkage_interval[0] > 0.0 && halves
    }
}

/// Draws of `n` units of `n`, with repetition, always the same ones.
fn resampled(n: usize, times: usize) -> impl Iterator<Item = Vec<usize>> {
    let mut random = Pcg64Mcg::new(0x5e_ed);
    let index = Uniform::new(0, n.max(1)).expect("a range that is not empty");
    (0..times).map(move |_| (0..n).map(|_| index.sample(&mut random)).collect())
}

fn interval(values: &mut [f64]) -> [f64; 2] {
    values.sort_by(f64::total_cmp);
    let at = |part: f64| values.get((part * values.len() as f64) as usize).copied().unwrap_or(0.0);
    [at(0.025), at(0.975)]
}

fn deviation(values: &[f64]) -> f64 {
    let n = values.len().max(1) as f64;
    let mean = values.iter().sum::<f64>() / n;
    (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / n).sqrt()
}

/// The probability of being this many deviations above zero: 1 - exp(-z^2 / 2) / 2, as of a normal
/// distribution's tail at most.
pub fn probability(certainty: f64) -> f64 {
    1.0 - 0.5 * (-0.5 * certainty.max(0.0).powi(2)).exp()
}
