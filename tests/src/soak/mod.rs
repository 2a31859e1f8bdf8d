//! A soak: a simulated arm, the whole board above its pins, a noisy line and a host, for hours.
//!
//! Sessions follow one another: upload of a random block, read back, arm, run, disarm. One
//! byte in a thousand is broken on the line, both ways. In some sessions an encoder jumps;
//! in some the board is reset. What must hold is asserted as it goes.

mod arm;
mod counters;
mod draw;
mod noisy_line;
mod session;
mod settings;

pub use counters::SoakCounters;
pub use session::Soak;
pub use settings::Settings;

/// Runs a soak; `progress` is told the sessions done.
///
/// # Panics
/// Something did not hold: the message says what and where.
pub fn soak(settings: &Settings, mut progress: impl FnMut(u32)) -> SoakCounters {
    let mut soak = Soak::new(settings);
    for session in 0..settings.sessions {
        soak.session(session);
        progress(session + 1);
    }
    soak.rest_until_the_end();
    soak.counters()
}
