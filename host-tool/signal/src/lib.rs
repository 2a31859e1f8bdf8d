//! Filters, derivatives and spectra of sampled signals; least squares with covariances.
#![forbid(unsafe_code)]

pub mod butterworth;
pub mod derivative;
pub mod estimation;
mod rms;
pub mod spectrum;
pub mod spectrum_window;
mod unwrapper;

pub use butterworth::LowPass;
pub use rms::rms;
pub use unwrapper::Unwrapper;
