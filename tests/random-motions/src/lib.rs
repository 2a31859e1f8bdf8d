//! Random motions that begin where the arm is, and the numbers that they are made of: for the soak of
//! the library (`cargo xtask soak`) and that of the emulated board.

mod rng;

use firmware::reference::{FadeIn, FourierSeries, Injection, Motion, Noise, Sine};

pub use rng::Rng;

/// A motion about an angle [rad]: none, there, a sine or a Fourier series, no further than so much [rad].
pub fn motion(rng: &mut Rng, centre_rad: f32, furthest_rad: f32) -> Motion {
    let fade_in = FadeIn { duration_s: 2.0 };
    let period_s = rng.between(3.0, 6.0);
    match rng.below(4) {
        0 => Motion::Hold { angle_rad: centre_rad },
        1 => Motion::Quintic {
            from_rad: centre_rad,
            to_rad: centre_rad + rng.between(-furthest_rad, furthest_rad),
            duration_s: period_s,
        },
        2 => {
            let amplitude_rad = rng.between(0.1, furthest_rad);
            Motion::Sine(Sine { centre_rad, amplitude_rad, period_s, fade_in })
        }
        _ => Motion::Fourier(FourierSeries {
            centre_rad,
            period_s: 2.0 * period_s,
            sine_rad: [0; 5].map(|_| rng.between(-0.1, 0.1)),
            cosine_rad: [0; 5].map(|_| rng.between(-0.1, 0.1)),
            fade_in,
        }),
    }
}

/// Noise in one of three cases.
pub fn injection(rng: &mut Rng) -> Injection {
    match rng.below(3) {
        0 => {
            let rms_v = rng.between(0.02, 0.1);
            Injection::Noise(Noise { rms_v, bandwidth_hz: 200.0, seed: rng.word() })
        }
        _ => Injection::None,
    }
}
