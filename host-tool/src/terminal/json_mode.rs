//! Whether answers are for programs.

use std::sync::atomic::{AtomicBool, Ordering};

static AS_JSON: AtomicBool = AtomicBool::new(false);

/// From now on answers are JSON.
pub fn wanted_as_json(wanted: bool) {
    AS_JSON.store(wanted, Ordering::Relaxed);
}

/// Whether they are.
pub fn is_json() -> bool {
    AS_JSON.load(Ordering::Relaxed)
}
