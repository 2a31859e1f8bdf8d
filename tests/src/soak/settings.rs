//! How long a soak is, and how noisy its line.

/// How long and how often.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Simulated time [s]; the sessions share it.
    pub duration_s: u32,
    /// Sessions, each with its own random parameters.
    pub sessions: u32,
    /// One byte in so many is broken.
    pub bytes_per_error: u32,
    /// Same seed, same soak.
    pub seed: u64,
}
