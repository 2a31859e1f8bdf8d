//! The noise of the Kalman filters, and their innovations.

use recordings::campaign::Known;
use serde::Serialize;

/// Variances of measurement and process noise.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct NoiseVariances {
    /// Of a measured angle [rad^2].
    pub measurement_rad2: f64,
    #[serde(rename = "command_V2")]
    /// Of white voltage noise, its mean over a millisecond [V^2].
    pub command_v2: f64,
}

impl NoiseVariances {
    /// Before tuning: rounding to the encoder's step, 4 mV of voltage noise.
    pub fn expected(known: &Known) -> Self {
        const COMMAND_V: f64 = 4e-3;
        let step_rad = known.encoder_step_rad;
        Self { measurement_rad2: step_rad * step_rad / 12.0, command_v2: COMMAND_V * COMMAND_V }
    }

    /// Variance of the voltage noise, its mean over a step [V^2].
    pub fn command_over_v2(&self, step_s: f64) -> f64 {
        self.command_v2 * 1e-3 / step_s
    }
}

/// Measured less predicted angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Innovation {
    /// The difference [rad].
    pub value_rad: f64,
    /// Its predicted variance [rad^2].
    pub variance_rad2: f64,
}

impl Innovation {
    /// Square over variance; 1 on average where the noises are right.
    pub fn normalised_square(&self) -> f64 {
        self.value_rad * self.value_rad / self.variance_rad2
    }

    /// Minus the logarithm of its normal density, without the constant.
    pub fn negative_log_likelihood(&self) -> f64 {
        0.5 * (self.normalised_square() + self.variance_rad2.ln())
    }
}
