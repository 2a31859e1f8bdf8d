//! Ctrl-C as a flag, for commands that must end things before they end.

use std::sync::atomic::{AtomicBool, Ordering};

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// From now on Ctrl-C (and the signals to end or hang up) raises this flag and does nothing
/// else. Where the system does not let one, the flag stays down.
pub fn interrupt() -> &'static AtomicBool {
    let _ = ctrlc::set_handler(|| INTERRUPTED.store(true, Ordering::Relaxed));
    &INTERRUPTED
}
