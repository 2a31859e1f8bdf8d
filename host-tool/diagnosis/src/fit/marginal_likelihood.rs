//! How likely the logs are by what is known of the parameters, whatever their values are.

use super::linearisation::Linearisation;
use super::unknowns::Expected;

impl Linearisation {
    /// Logarithm of the marginal likelihood of the train rows, by the slopes, where this is known of what
    /// is open: sum(ln(1/deviation)) - ln(det N) / 2 - objective / 2, but for a constant that is the same
    /// for all that may be known (MacKay, Bayesian Interpolation, 1992, the evidence). `None` where the
    /// numbers do not work out.
    pub fn log_marginal_likelihood(&self, known: Vec<Expected>) -> Option<f64> {
        let linear = self.with_known(known)?;
        let widths: f64 = linear.expected.iter().map(|expected| expected.deviation.ln()).sum();
        let factor = linear.normal.l_dirty();
        let half_log_det: f64 = (0..factor.nrows()).map(|k| factor[(k, k)].ln()).sum();
        Some(-widths - half_log_det - 0.5 * linear.refitted_objective())
    }
}
