//! Libraries that panic at damaged data, made to say so instead.

use std::any::Any;
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};
use std::sync::Once;

thread_local! {
    /// Whether a panic of this thread is awaited, and not to be printed.
    static IS_AWAITED: Cell<bool> = const { Cell::new(false) };
}

/// What `read` returns, or what it panicked with; nothing is printed of that.
pub(super) fn guarded<T>(read: impl FnOnce() -> T) -> Result<T, String> {
    hush_awaited();
    IS_AWAITED.set(true);
    // What was read so far is dropped with the panic.
    let result = catch_unwind(AssertUnwindSafe(read));
    IS_AWAITED.set(false);
    result.map_err(|panic| message(panic.as_ref()))
}

/// Puts a hook before the one that prints panics, once for the process.
fn hush_awaited() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let print = take_hook();
        set_hook(Box::new(move |panic| {
            if !IS_AWAITED.get() {
                print(panic);
            }
        }));
    });
}

fn message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
    text.unwrap_or_else(|| "its parts contradict each other".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_its_message() {
        assert_eq!(guarded(|| 3), Ok(3));
        assert_eq!(guarded(|| -> u8 { panic!("cut at {}", 7) }), Err("cut at 7".to_owned()));
    }
}
