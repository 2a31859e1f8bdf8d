//! What happens when nothing can be trusted any more: 0 V, then a reset.
//!
//! A panic ends here too, as panic-probe raises a hard fault once it has logged.
//! The watchdog, which nobody pets any more, resets the board within 34 ms, and a
//! board that comes out of a watchdog's reset is faulted and puts out 0 V. Where it was and why stays
//! in the memory that a reset leaves alone, and is told as the fault.

use core::sync::atomic::Ordering::Relaxed;

use cortex_m::peripheral::SCB;
use cortex_m_rt::{ExceptionFrame, exception};
use embassy_stm32::pac;
use firmware::supervisor::{Fault, FaultRecord, Kept};

use crate::exchange::SHARED;
use crate::latch;

/// CLR of the converter is PB10.
const CLEAR_PIN: usize = 10;
/// The amplifiers' enable is PC6, the brakes' release PC9.
const DRIVE_PINS: [usize; 2] = [6, 9];

/// Pulls CLR low, disables amplifiers and engages brakes; touches two registers, so it works
/// whatever has gone wrong.
fn outputs_to_zero() {
    pac::GPIOB.bsrr().write(|w| w.set_br(CLEAR_PIN, true));
    pac::GPIOC.bsrr().write(|w| DRIVE_PINS.iter().for_each(|pin| w.set_br(*pin, true)));
}

/// 0 V, and nothing else until the watchdog resets the board.
pub fn wait_for_reset() -> ! {
    outputs_to_zero();
    loop {
        cortex_m::asm::nop();
    }
}

// SAFETY: the outputs are safe before anything else is touched, and nothing else runs any more.
#[exception]
unsafe fn HardFault(frame: &ExceptionFrame) -> ! {
    outputs_to_zero();
    keep_crash(frame.pc());
    wait_for_reset()
}

/// The crystal has failed: every time is wrong by a factor of ten.
pub fn crystal_failed() -> ! {
    outputs_to_zero();
    let tick = SHARED.ticks.load(Relaxed);
    keep(FaultRecord { fault: Fault::Crystal, joint: 0, tick, value: 0.0, limit: 0.0 });
    wait_for_reset()
}

/// Where it was and why, for the next boot.
fn keep_crash(program_counter: u32) {
    // SAFETY: reading the status has no effect.
    let status = unsafe { (*SCB::PTR).cfsr.read() };
    keep(FaultRecord::of_crash(SHARED.ticks.load(Relaxed), program_counter, status));
}

/// Keeps a fault for the next boot, unless another one came before it.
fn keep(record: FaultRecord) {
    if latch::read().fault().is_none() {
        latch::write(&Kept::Fault(record));
    }
}

// SAFETY: as above; an interrupt that nobody expects is a fault like any other.
#[exception]
unsafe fn DefaultHandler(_: i16) -> ! {
    wait_for_reset()
}
