//! Random numbers for the sizes of effects.

use std::f64::consts::PI;

/// A source of random numbers.
pub trait Random {
    /// Evenly from 0 to 1.
    fn unit(&mut self) -> f64;

    /// Evenly from a range.
    fn uniform(&mut self, lowest: f64, highest: f64) -> f64 {
        lowest + (highest - lowest) * self.unit()
    }

    /// From a range above 0, evenly in the logarithm.
    fn log_uniform(&mut self, lowest: f64, highest: f64) -> f64 {
        self.uniform(lowest.ln(), highest.ln()).exp()
    }

    /// The same, of either sign.
    fn signed_log_uniform(&mut self, lowest: f64, highest: f64) -> f64 {
        let size = self.log_uniform(lowest, highest);
        if self.unit() < 0.5 { -size } else { size }
    }

    /// A whole number from 1 to `highest`.
    fn harmonic(&mut self, highest: u32) -> f64 {
        1.0 + (self.unit() * f64::from(highest)).floor()
    }

    /// An angle of the whole turn [rad].
    fn phase_rad(&mut self) -> f64 {
        self.uniform(-PI, PI)
    }

    /// A number below 2^32, for seeds.
    fn seed(&mut self) -> u32 {
        (self.unit() * f64::from(u32::MAX)) as u32
    }
}
