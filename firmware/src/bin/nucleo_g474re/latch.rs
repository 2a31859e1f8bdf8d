//! Memory that a reset leaves alone: the latched fault, or that the board is armed.

use core::mem::MaybeUninit;
use core::ptr;

use firmware::supervisor::{Kept, Latch};

/// Neither set to zero nor filled at a reset.
#[unsafe(link_section = ".uninit.LATCH")]
static mut LATCH: MaybeUninit<Latch> = MaybeUninit::uninit();

/// What was kept before the reset; call it before the ticks begin, or after a crash.
pub fn read() -> Kept {
    // SAFETY: all bytes of a `Latch` may have any value; nothing else runs yet, or any more.
    let latch = unsafe { ptr::read_volatile((&raw const LATCH).cast::<Latch>()) };
    latch.kept()
}

/// Keeps it; for the tick, and for the boot before it.
pub fn write(kept: &Kept) {
    // SAFETY: only the tick comes here once ticks have begun, and nothing reads after that.
    unsafe { ptr::write_volatile((&raw mut LATCH).cast::<Latch>(), Latch::of(kept)) };
}
