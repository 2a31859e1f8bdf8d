//! Filters, derivatives and spectra of sampled signals.

pub mod spectrum;
pub mod spectrum_window;
