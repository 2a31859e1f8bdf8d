//! What happens when nothing can be trusted any more: 0 V, then a reset.
//!
//! A panic ends here too, as panic-probe raises a hard fault once it has logged.
//! The watchdog, which nobody pets any more, resets the board within 34 ms, and a
//! board that comes out of a watchdog's reset is faulted and puts out 0 V.

use cortex_m_rt::{ExceptionFrame, exception};
use embassy_stm32::pac;

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

// SAFETY: touches nothing but the register of one pin, and does not return.
#[exception]
unsafe fn HardFault(_: &ExceptionFrame) -> ! {
    wait_for_reset()
}

// SAFETY: as above; an interrupt that nobody expects is a fault like any other.
#[exception]
unsafe fn DefaultHandler(_: i16) -> ! {
    wait_for_reset()
}
