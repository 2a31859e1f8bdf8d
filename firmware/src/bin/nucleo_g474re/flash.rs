//! Bank 2 of the flash, and the store in it. Code runs from bank 1 meanwhile.
//!
//! Erasing a page takes 25 ms at most, in which the thread waits and the ticks go on.

use core::sync::atomic::Ordering::Relaxed;

use embassy_stm32::Peri;
use embassy_stm32::flash::{Blocking, Error, Flash, WRITE_SIZE};
use embassy_stm32::peripherals::FLASH;
use embedded_storage::nor_flash::{ErrorType, NorFlash, ReadNorFlash};
use firmware::store::{Layout, Store};

use crate::exchange::REPORT;
use crate::watchdog;

/// Where the driver counts from.
const ORIGIN: u32 = 0x0800_0000;

/// The board's flash.
pub struct BoardFlash {
    flash: Flash<'static, Blocking>,
    ticks_seen: u32,
}

/// The store in bank 2.
pub fn store(flash: Peri<'static, FLASH>) -> Store<BoardFlash> {
    let flash = BoardFlash { flash: Flash::new_blocking(flash), ticks_seen: 0 };
    Store::new(flash, ORIGIN, Layout::G474)
}

impl BoardFlash {
    /// Before the thread waits or checks a block, 25 ms at most; only as long as the ticks go on.
    fn pet(&mut self) {
        let ticks = REPORT.ticks.load(Relaxed);
        if ticks != self.ticks_seen {
            watchdog::pet_before_waiting();
        }
        self.ticks_seen = ticks;
    }
}

impl ErrorType for BoardFlash {
    type Error = Error;
}

impl ReadNorFlash for BoardFlash {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Error> {
        self.pet();
        self.flash.blocking_read(offset, bytes)
    }

    fn capacity(&self) -> usize {
        Layout::G474.used_bytes() as usize + (Layout::G474.bank_start - ORIGIN) as usize
    }
}

impl NorFlash for BoardFlash {
    const WRITE_SIZE: usize = WRITE_SIZE;
    const ERASE_SIZE: usize = Layout::G474.page_bytes as usize;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), Error> {
        for page in (from..to).step_by(Self::ERASE_SIZE) {
            self.pet();
            self.flash.blocking_erase(page, page + Self::ERASE_SIZE as u32)?;
        }
        Ok(())
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Error> {
        self.pet();
        self.flash.blocking_write(offset, bytes)
    }
}
