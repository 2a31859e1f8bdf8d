//! The first CMSDK timer, 25 MHz, counting down.
//!
//! Under `-icount shift=10` an instruction takes 1024 ns, so it is 25.6 counts.

use core::ptr;

const CONTROL: *mut u32 = 0x4000_0000 as *mut u32;
const VALUE: *mut u32 = 0x4000_0004 as *mut u32;
const RELOAD: *mut u32 = 0x4000_0008 as *mut u32;

/// Lets it run for ever.
pub fn start() {
    // SAFETY: the registers of a timer that nothing else uses.
    unsafe {
        ptr::write_volatile(RELOAD, u32::MAX);
        ptr::write_volatile(VALUE, u32::MAX);
        ptr::write_volatile(CONTROL, 1);
    }
}

/// Counts since the start, wrapping.
pub fn now() -> u32 {
    // SAFETY: reading has no side effect.
    !unsafe { ptr::read_volatile(VALUE) }
}
