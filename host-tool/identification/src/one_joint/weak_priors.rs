//! Weak priors of the grey-box fit.

use super::parameters::JITTER;

/// A normally distributed weighted sum of parameters.
pub struct Prior {
    /// Parameter indices and their weights.
    weights: &'static [(usize, f64)],
    mean: f64,
    deviation: f64,
}

/// Priors so weak that any data outweigh them; they keep the search within bounds, and
/// the covariance finite where the data do not determine a parameter.
pub const PRIORS: [Prior; 5] = [
    // Breakaway level within a factor of two of the Coulomb level.
    Prior { weights: &[(1, 1.0), (0, -1.0)], mean: 0.0, deviation: 0.7 },
    // v_s about 4 mrad/s, within a factor of four.
    Prior { weights: &[(2, 1.0)], mean: -5.5, deviation: 1.4 },
    // sigma_0 and sigma_1 about 300 V/rad and 3 V s/rad, within a factor of seven.
    Prior { weights: &[(4, 1.0)], mean: 5.7, deviation: 2.0 },
    Prior { weights: &[(5, 1.0)], mean: 1.1, deviation: 2.0 },
    // Jitter about 0.2 mrad/s.
    Prior { weights: &[(JITTER, 1.0)], mean: -8.5, deviation: 3.0 },
];
/// The residual that counts as one standard deviation of a prior [V].
pub const DEVIATION_V: f64 = 1e-3;

impl Prior {
    /// Residual at the parameters [V].
    pub fn residual_v(&self, parameters: &[f64]) -> f64 {
        let sum: f64 = self.weights.iter().map(|&(k, w)| w * parameters[k]).sum();
        DEVIATION_V * (sum - self.mean) / self.deviation
    }

    /// Its derivative by a parameter.
    pub fn derivative(&self, parameter: usize) -> f64 {
        let weight = self.weights.iter().find(|&&(k, _)| k == parameter);
        weight.map_or(0.0, |&(_, w)| DEVIATION_V * w / self.deviation)
    }
}
