//! Memory that a reset leaves alone, with the latched fault.

use core::mem::MaybeUninit;
use core::ptr;

use firmware::supervisor::FaultRecord;
use firmware::supervisor::latch::Latch;

/// Neither set to zero nor filled at a reset.
#[unsafe(link_section = ".uninit.LATCH")]
static mut LATCH: MaybeUninit<Latch> = MaybeUninit::uninit();

/// The fault that was latched before the reset; call it before the ticks begin, or after a crash.
pub fn read() -> Option<FaultRecord> {
    // SAFETY: all bytes of a `Latch` may have any value; nothing else runs yet, or any more.
    let latch = unsafe { ptr::read_volatile((&raw const LATCH).cast::<Latch>()) };
    latch.fault()
}

/// Latches a fault, or none; for the tick, and for the boot before it.
pub fn write(fault: Option<&FaultRecord>) {
    // SAFETY: only the tick comes here once ticks have begun, and nothing reads after that.
    unsafe { ptr::write_volatile((&raw mut LATCH).cast::<Latch>(), Latch::of(fault)) };
}
