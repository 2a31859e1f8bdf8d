//! Filters, derivatives and spectra of sampled signals.
