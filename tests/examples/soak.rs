//! The soak: `cargo run --release -p tests --example soak -- HOURS [SESSIONS] [SEED]`.

use std::time::Instant;

use tests::soak::{Settings, soak};

fn main() {
    let numbers: Vec<f64> = std::env::args().skip(1).filter_map(|a| a.parse().ok()).collect();
    let number = |index: usize, otherwise: f64| numbers.get(index).copied().unwrap_or(otherwise);
    let settings = Settings {
        duration_s: (3600.0 * number(0, 24.0)) as u32,
        // A hundred in a day: shorter ones are too few swings to tell whether errors grow.
        sessions: number(1, (number(0, 24.0) / 0.24).max(1.0)) as u32,
        bytes_per_error: 1000,
        seed: number(2, 1.0) as u64,
    };
    println!("{settings:?}");
    let begin = Instant::now();
    let counters = soak(&settings, |done| {
        if done % 10 == 0 {
            eprintln!("{done} of {} sessions", settings.sessions);
        }
    });
    println!("{counters}in {:.0} s", begin.elapsed().as_secs_f64());
}
