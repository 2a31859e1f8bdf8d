//! Samples that are taken early or late while their times tell nothing of it: an error of the position
//! that grows with speed.
//!
//! A difference of eighth order of the angles leaves what is rough from sample to sample. Where that is
//! larger while a joint moves fast than while it is slow, by more than the encoder's steps, the clock
//! jitters: sigma_q = jitter |qd|.

use crate::criteria::LogCriteria;

/// Binomial coefficients of the eighth difference.
const DIFFERENCE: [f64; 9] = [1.0, -8.0, 28.0, -56.0, 70.0, -56.0, 28.0, -8.0, 1.0];
/// The sum of their squares.
const SQUARES: f64 = 12_870.0;
/// Median of the squares of a Gaussian variable of unit variance.
const MEDIAN_SQUARE: f64 = 0.454_936;

/// Time by which samples of angles as rough as these lie off, rms [s]; all joints have one clock. Zero
/// where nothing grows with speed.
pub fn jitter_s<'a>(angles: impl IntoIterator<Item = &'a Roughness>) -> f64 {
    let (mut growth, mut speeds) = (0.0, 0.0);
    for roughness in angles {
        growth += roughness.growth_rad2;
        speeds += roughness.speed2;
    }
    if speeds > 0.0 { (growth / speeds).sqrt() } else { 0.0 }
}

/// How much rougher a joint's angles are while it is fast.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Roughness {
    /// Mean square by which they are rougher, summed over samples [rad^2].
    growth_rad2: f64,
    /// Squares of the speed, summed over the same [rad^2/s^2].
    speed2: f64,
}

impl Roughness {
    /// Of angles [rad] at an even period [s], read in these steps [rad]; none for a joint that does
    /// not move.
    pub fn of(q_rad: &[f64], period_s: f64, step_rad: f64, criteria: &LogCriteria) -> Self {
        Self::if_moving(q_rad, period_s, step_rad, criteria).unwrap_or_default()
    }

    fn if_moving(
        q_rad: &[f64],
        period_s: f64,
        step_rad: f64,
        criteria: &LogCriteria,
    ) -> Option<Self> {
        let samples = speeds_and_roughness(q_rad, period_s);
        let mut speeds2: Vec<f64> = samples.iter().map(|sample| sample.0).collect();
        speeds2.sort_unstable_by(f64::total_cmp);
        let at = |part: f64| speeds2.get((part * speeds2.len() as f64) as usize).copied();
        let (slow, fast) = (at(criteria.slow_part)?, at(criteria.fast_speeds_part)?);
        let (below, _) = typical(samples.iter().filter(|sample| sample.0 <= slow))?;
        let (above, speed2) = typical(samples.iter().filter(|sample| sample.0 > fast))?;
        let growth = above - below.max(step_rad * step_rad / 12.0);
        let count = samples.len() as f64;
        let is_growth = growth > criteria.least_rough_growth * below;
        Some(Self {
            growth_rad2: if is_growth { count * growth } else { 0.0 },
            speed2: count * speed2,
        })
    }
}

/// Squares of the speed, and of the eighth differences about the same sample.
fn speeds_and_roughness(q_rad: &[f64], period_s: f64) -> Vec<(f64, f64)> {
    let half = DIFFERENCE.len() / 2;
    let speed2 = |window: &[f64]| {
        ((window[window.len() - 1] - window[0]) / (2.0 * half as f64 * period_s)).powi(2)
    };
    let speeds2 = q_rad.windows(DIFFERENCE.len()).map(speed2);
    speeds2.zip(eighth_differences_squared(q_rad)).collect()
}

/// Variance of the angles' roughness by its median, which single bumps do not move, and the median
/// square of the speed.
fn typical<'a>(samples: impl Iterator<Item = &'a (f64, f64)>) -> Option<(f64, f64)> {
    let (mut speeds2, mut rough2): (Vec<f64>, Vec<f64>) = samples.copied().unzip();
    let middle = speeds2.len() / 2;
    (!speeds2.is_empty()).then(|| {
        let speed2 = *speeds2.select_nth_unstable_by(middle, f64::total_cmp).1;
        let rough2 = *rough2.select_nth_unstable_by(middle, f64::total_cmp).1;
        (rough2 / (MEDIAN_SQUARE * SQUARES), speed2)
    })
}

fn eighth_differences_squared(angles: &[f64]) -> impl Iterator<Item = f64> + '_ {
    let difference = |window: &[f64]| -> f64 {
        window.iter().zip(DIFFERENCE).map(|(angle, weight)| weight * angle).sum()
    };
    angles.windows(DIFFERENCE.len()).map(move |window| difference(window).powi(2))
}

#[cfg(test)]
mod tests {
    use rand_distr::{Distribution, StandardNormal};
    use rand_pcg::Pcg64Mcg;

    use super::*;

    #[test]
    fn a_clock_that_jitters_shows_by_how_much() {
        const JITTER_S: f64 = 1e-4;
        let mut random = Pcg64Mcg::new(5);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let swing = |t: f64| (3.0 * t).sin();
        let read = |step_rad: f64, jitter_s: f64, normal: &mut dyn FnMut() -> f64| -> Vec<f64> {
            let at = |k: u32| swing(f64::from(k) * 1e-3 + jitter_s * normal());
            (0..20_000).map(at).map(|q| (q / step_rad).round() * step_rad).collect()
        };
        let criteria = LogCriteria::default();
        let found = |jitter_s: f64, normal: &mut dyn FnMut() -> f64| {
            let angles = read(1e-5, jitter_s, normal);
            super::jitter_s([&Roughness::of(&angles, 1e-3, 1e-5, &criteria)])
        };
        let ratio = found(JITTER_S, &mut normal) / JITTER_S;
        assert!((ratio - 1.0).abs() < 0.2, "{ratio}");
        assert!(found(0.0, &mut normal) < 1e-6);
    }

    #[test]
    fn a_white_signal_has_its_variance() {
        let mut random = Pcg64Mcg::new(3);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let angles: Vec<f64> = (0..20_000).map(|_| 1e-3 * normal()).collect();
        let squares = eighth_differences_squared(&angles);
        let samples: Vec<(f64, f64)> = squares.map(|square| (1.0, square)).collect();
        let (variance, _) = typical(samples.iter()).unwrap();
        assert!((variance / 1e-6 - 1.0).abs() < 0.1, "{variance:e}");
    }
}
