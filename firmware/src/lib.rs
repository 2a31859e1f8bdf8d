//! The RRR joint controller without its hardware.
#![cfg_attr(not(test), no_std)]
