//! A soak: a simulated arm, the whole board above its pins, a noisy line and a host, for hours.
//!
//! Sessions follow one another: upload of a random block, read back, arm, run, disarm. One
//! byte in a thousand is broken on the line, both ways. In some sessions an encoder jumps;
//! in some the board is reset. What must hold is asserted as it goes.

mod arm;
mod draw;
mod noisy_line;
mod rng;
mod session;
mod tally;

pub use session::Soak;
pub use tally::Tally;

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

/// Runs a soak; `progress` is told the sessions done.
///
/// # Panics
/// Something did not hold: the message says what and where.
pub fn soak(settings: &Settings, mut progress: impl FnMut(u32)) -> Tally {
    let mut soak = Soak::new(settings);
    for session in 0..settings.sessions {
        soak.session(session);
        progress(session + 1);
    }
    soak.rest_until_the_end();
    soak.tally()
}
