//! What the engine lacks of a Cortex-M4: exceptions, their controller and the time they take.

pub mod cost;
pub mod exceptions;
pub mod nvic;
pub mod system_control;
