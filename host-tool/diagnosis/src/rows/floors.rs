//! Filters that make a joint's rows white, and the noise that they leave.

use super::noise::{Noise, NoiseByRate};
use super::row_filter::RowFilter;
use crate::criteria::Criteria;
use crate::logs::stretch::Stretch;

/// Filters of a joint's rows that make its noise white, stretch by stretch.
pub(super) fn filters(
    stretches: &[Stretch],
    joint: usize,
    noise: &NoiseByRate,
    criteria: &Criteria,
) -> Vec<RowFilter> {
    let of_rows = &criteria.rows;
    let filter = |s: &Stretch| {
        let corner_hz = noise.in_stretch(joint, s).corner_hz();
        let highest_hz = of_rows.highest_corner_part / s.period_s;
        let corner_hz = corner_hz.clamp(of_rows.lowest_corner_hz, highest_hz);
        RowFilter::new(s.period_s, s.broadband, corner_hz, of_rows)
    };
    stretches.iter().map(filter).collect()
}

/// Noise of a joint's rows in a stretch, rms [V]: what is seen, and what happens between samples.
pub(super) fn floor_v(
    stretch: &Stretch,
    filter: &RowFilter,
    joint: usize,
    noise: &NoiseByRate,
    criteria: &Criteria,
) -> f64 {
    let seen_v = behind(filter, stretch, noise.in_stretch(joint, stretch));
    let fast_v = stretch.fast_command_v(joint, criteria.logs.fast_part);
    seen_v.hypot(criteria.rows.between_samples_per_s * stretch.period_s * fast_v)
}

/// What a filter leaves of noise, rms [V].
pub(super) fn behind(filter: &RowFilter, stretch: &Stretch, noise: Noise) -> f64 {
    noise.behind(|f| filter.gain(f), stretch.period_s)
}
