//! Filters, derivatives and spectra of sampled signals.

pub mod butterworth;
pub mod derivative;
pub mod spectrum;
pub mod spectrum_window;

pub use butterworth::LowPass;
