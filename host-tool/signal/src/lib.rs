//! Filters, derivatives and spectra of sampled signals; least squares with covariances.
//!
//! A low-pass without phase, as the paper filters its recorded motion:
//!
//! ```
//! use signal::LowPass;
//!
//! let slow = |k: i32| (std::f64::consts::TAU * 2e-3 * f64::from(k)).sin();
//! let alternating = |k: i32| if k % 2 == 0 { 0.1 } else { -0.1 };
//! let noisy: Vec<f64> = (0..2000).map(|k| slow(k) + alternating(k)).collect();
//! let smooth = LowPass::new(20.0, 1e-3).zero_phase(&noisy);
//! assert!((smooth[1100] - slow(1100)).abs() < 1e-4);
//! ```
#![forbid(unsafe_code)]

pub mod butterworth;
pub mod derivative;
pub mod estimation;
mod play;
mod rms;
pub mod spectrum;
pub mod spectrum_window;
mod unwrapper;

pub use butterworth::LowPass;
pub use play::play;
pub use rms::rms;
pub use unwrapper::Unwrapper;
