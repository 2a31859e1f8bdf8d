//! The first CMSDK UART, polled: the serial line to the host.
//!
//! QEMU's `-serial` says where it ends: `pty`, `tcp:...`, `unix:...`.

use core::ptr;

use firmware::link::{BlockStore, BoardRuntime};

const DATA: *mut u32 = 0x4000_4000 as *mut u32;
const STATE: *mut u32 = 0x4000_4004 as *mut u32;
const CONTROL: *mut u32 = 0x4000_4008 as *mut u32;
const DIVIDER: *mut u32 = 0x4000_4010 as *mut u32;

const SENDER_FULL: u32 = 1;
const RECEIVER_FULL: u32 = 2;
/// Send and receive.
const ENABLE: u32 = 3;
/// 25 MHz / 27; QEMU wants a number of 16 or more and pays no heed to it otherwise.
const CLOCKS_PER_BIT: u32 = 27;

/// What a tick leaves time for, each way [bytes]: as much as 921,600 baud carry in 1 ms.
const BYTES_PER_TICK: u32 = 92;

/// The line.
pub struct Line(());

impl Line {
    /// Switches it on.
    pub fn open() -> Self {
        // SAFETY: the registers of an UART that nothing else uses.
        unsafe {
            ptr::write_volatile(DIVIDER, CLOCKS_PER_BIT);
            ptr::write_volatile(CONTROL, ENABLE);
        }
        Self(())
    }

    /// Takes what has come and sends what waits, a bounded number of bytes; never waits.
    pub fn serve(&mut self, runtime: &mut BoardRuntime<impl BlockStore>) {
        for _ in 0..BYTES_PER_TICK {
            let Some(byte) = self.receive() else { break };
            runtime.receive(byte);
        }
        for _ in 0..BYTES_PER_TICK {
            if !self.can_send() {
                break;
            }
            let Some(byte) = runtime.send() else { break };
            self.send(byte);
        }
    }

    fn receive(&mut self) -> Option<u8> {
        // SAFETY: reading the data takes the byte that is there.
        unsafe {
            let there = ptr::read_volatile(STATE) & RECEIVER_FULL != 0;
            there.then(|| ptr::read_volatile(DATA) as u8)
        }
    }

    fn can_send(&self) -> bool {
        // SAFETY: reading the state has no side effect.
        unsafe { ptr::read_volatile(STATE) & SENDER_FULL == 0 }
    }

    fn send(&mut self, byte: u8) {
        // SAFETY: the sender has room.
        unsafe { ptr::write_volatile(DATA, u32::from(byte)) }
    }
}
