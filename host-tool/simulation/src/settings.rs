//! How the robot is simulated.

/// How the robot is simulated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Time between commands [s].
    pub sample_period_s: f64,
    /// Integration steps per command.
    pub substeps: u32,
    /// Amplifier noise, one sample per command [V rms].
    pub noise_v: f64,
    /// Same seed, same noise.
    pub seed: u64,
}

impl Default for Settings {
    fn default() -> Self {
        Self { sample_period_s: 1e-3, substeps: 10, noise_v: 4e-3, seed: 1 }
    }
}
