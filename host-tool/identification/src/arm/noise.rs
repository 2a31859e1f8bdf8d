//! The noise of a position's reading.

/// Differences of this order leave next to nothing of a motion below a tenth of the rate.
const ORDER: usize = 8;
/// What they make of white noise: the sum of the squares of the binomial coefficients of 8.
const GAIN: f64 = 12870.0;
/// Standard deviation by median of absolute values, of a normal distribution.
const DEVIATION_BY_MEDIAN: f64 = 1.4826;

/// Standard deviation of a position's noise [rad; m]: what differences of eighth order show, but
/// at least the rounding of the encoder's step.
pub fn position_noise(position: &[f64], encoder_step: Option<f64>) -> f64 {
    let rounding = encoder_step.map_or(0.0, |step| step.abs() / 12.0_f64.sqrt());
    let mut values = position.to_vec();
    for _ in 0..ORDER {
        values = values.windows(2).map(|pair| pair[1] - pair[0]).collect();
    }
    if values.is_empty() {
        return rounding;
    }
    values.iter_mut().for_each(|value| *value = value.abs());
    let middle = values.len() / 2;
    let median = *values.select_nth_unstable_by(middle, f64::total_cmp).1;
    rounding.max(DEVIATION_BY_MEDIAN * median / GAIN.sqrt())
}

/// What white noise of a position becomes below a cut-off in velocity [1/s] and acceleration
/// [1/s^2]: its one-sided density 2 T sigma^2 times (2 pi f)^2 and ^4, integrated up to there.
pub fn derivative_noise(noise: f64, cutoff_hz: f64, period_s: f64) -> [f64; 2] {
    let turn = std::f64::consts::TAU;
    let density = 2.0 * period_s * noise * noise;
    [
        turn * (density * cutoff_hz.powi(3) / 3.0).sqrt(),
        turn * turn * (density * cutoff_hz.powi(5) / 5.0).sqrt(),
    ]
}

#[cfg(test)]
mod tests {
    use rand_distr::{Distribution, Normal};
    use rand_pcg::Pcg64Mcg;

    use super::*;

    #[test]
    fn a_step_and_alternating_noise_are_seen_on_a_motion() {
        let motion = |k: u32| (0.01 * f64::from(k)).sin();
        let smooth: Vec<f64> = (0..2000).map(motion).collect();
        assert!(position_noise(&smooth, None) < 1e-12);
        assert!((position_noise(&smooth, Some(0.12_f64.sqrt())) - 0.1).abs() < 1e-12);
        let mut random = Pcg64Mcg::new(1);
        let normal = Normal::new(0.0, 1e-3).unwrap();
        let noisy = smooth.iter().map(|q| q + normal.sample(&mut random));
        let found = position_noise(&noisy.collect::<Vec<_>>(), None);
        assert!((found / 1e-3 - 1.0).abs() < 0.1, "{found}");
    }
}
