//! A first look at files of others: a `dataset.toml` for them, with what was guessed and what is open.

mod draft;
mod gaps;
mod look;
mod pairs;
mod plan;
mod text;

pub use draft::{Draft, draft};
