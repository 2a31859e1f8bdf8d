//! From signals on the log's clock to rows that are compared.
//!
//! Both sides of every equation go through the same filter without phase. Noise of the
//! amplifier is white; that of the encoder's steps, differentiated twice, grows with the
//! square of frequency. A first-order low-pass forwards and backwards, with its corner where
//! the two are equal, makes both together nearly white.

use crate::criteria::RowCriteria;
use signal::{LowPass, derivative};

/// Turns signals into rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RowFilter {
    low_pass: LowPass,
    /// Samples at either end that make no rows.
    margin: usize,
    /// Samples per row.
    every: usize,
    period_s: f64,
}

impl RowFilter {
    /// For signals of a period; `broadband` where the motion is driven at high frequencies,
    /// `corner_hz` as above.
    pub fn new(period_s: f64, broadband: bool, corner_hz: f64, criteria: &RowCriteria) -> Self {
        let wanted =
            if broadband { criteria.broadband_rows_per_s } else { criteria.calm_rows_per_s };
        let every = (1.0 / (wanted * period_s)).round().max(1.0);
        let cutoff_hz = criteria.cutoff_part / (every * period_s);
        Self {
            low_pass: LowPass::new(cutoff_hz, period_s).behind_first_order(corner_hz, period_s),
            margin: (criteria.margin_s / period_s).round() as usize,
            every: every as usize,
            period_s,
        }
    }

    /// The signal's values in the rows.
    pub fn rows(&self, signal: &[f64]) -> Vec<f64> {
        let inside = signal.len().saturating_sub(self.margin);
        let filtered = self.smooth(signal);
        derivative::decimated(&filtered[..inside], self.margin, self.every)
    }

    /// The signal without what rows do not see, on the log's clock.
    pub fn smooth(&self, signal: &[f64]) -> Vec<f64> {
        self.low_pass.zero_phase(signal)
    }

    /// Gain at a frequency.
    pub fn gain(&self, frequency_hz: f64) -> f64 {
        self.low_pass.gain(frequency_hz, self.period_s)
    }

    /// Indices of the samples that make rows, of a signal of this length.
    pub fn instants(&self, count: usize) -> impl Iterator<Item = usize> + use<> {
        (self.margin..count.saturating_sub(self.margin)).step_by(self.every)
    }

    /// How many rows a signal of this length makes.
    pub fn row_count(&self, count: usize) -> usize {
        self.instants(count).count()
    }

    /// Time from row to row [s].
    pub fn row_period_s(&self) -> f64 {
        self.every as f64 * self.period_s
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    #[test]
    fn a_sine_takes_the_gain_that_is_told() {
        let filter = RowFilter::new(1e-3, false, 20.0, &RowCriteria::default());
        for frequency_hz in [2.0, 20.0, 50.0] {
            let sine: Vec<f64> =
                (0..4000).map(|k| (TAU * frequency_hz * f64::from(k) * 1e-3).sin()).collect();
            let rows = filter.rows(&sine);
            assert_eq!(rows.len(), filter.row_count(sine.len()));
            for (k, row) in filter.instants(4000).zip(rows) {
                assert!((row - filter.gain(frequency_hz) * sine[k]).abs() < 2e-3, "{frequency_hz}");
            }
        }
    }
}
