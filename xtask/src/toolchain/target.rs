//! What the firmware is compiled for.

/// Cortex-M4 with its single-precision FPU.
pub const TARGET: &str = "thumbv7em-none-eabihf";
