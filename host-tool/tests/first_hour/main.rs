//! The first hour of a new user: what once hurt, one test a sentence, one file a theme.

mod formats;
mod inputs;
mod inverse_dynamics;
mod joints;
mod mcap_logs;
mod reports;
mod rrr;
mod simulate;
mod verdicts;
