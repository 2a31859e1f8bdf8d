//! Bank 2 of the flash, and the store in it. Code runs from bank 1 meanwhile.
//!
//! Erasing a page takes 25 ms at most, in which the thread waits and the ticks go on. A word
//! that was being written when the power failed may have a checksum (ECC) that does not fit:
//! reading it raises the NMI, which notes it, and the read reports an error instead.

use core::sync::atomic::AtomicBool;
use core::sync::atomic::Ordering::Relaxed;

use cortex_m_rt::exception;
use embassy_stm32::flash::{Blocking, Error, Flash, WRITE_SIZE};
use embassy_stm32::peripherals::FLASH;
use embassy_stm32::{Peri, pac};
use embedded_storage::nor_flash::{
    ErrorType, NorFlash, NorFlashError, NorFlashErrorKind, ReadNorFlash, check_erase, check_read,
    check_write,
};
use firmware::store::{Layout, Store};

use crate::exchange::SHARED;
use crate::safe_state::{crystal_failed, wait_for_reset};
use crate::watchdog;

const LAYOUT: Layout = Layout::G474;
/// Where bank 2 begins for the driver, which counts from bank 1 on.
const BANK_AT: u32 = LAYOUT.bank_start - 0x0800_0000;

/// A word of bank 2 was read whose checksum does not fit.
static UNREADABLE: AtomicBool = AtomicBool::new(false);

/// Bank 2; offset 0 is its begin, so nothing here reaches bank 1.
pub struct BoardFlash {
    flash: Flash<'static, Blocking>,
    ticks_seen: u32,
}

/// The store in bank 2.
pub fn store(flash: Peri<'static, FLASH>) -> Store<BoardFlash> {
    let flash = BoardFlash { flash: Flash::new_blocking(flash), ticks_seen: 0 };
    Store::new(flash, LAYOUT.bank_start, LAYOUT)
}

impl BoardFlash {
    /// Before the thread waits or checks a block, 25 ms at most; only as long as the ticks go on.
    fn pet(&mut self) {
        let ticks = SHARED.ticks.load(Relaxed);
        if ticks != self.ticks_seen {
            watchdog::pet_before_waiting();
        }
        self.ticks_seen = ticks;
    }
}

/// Why bank 2 did not do something.
#[derive(Debug)]
pub enum FlashError {
    /// A word's checksum does not fit.
    Unreadable,
    /// The arguments.
    Arguments(NorFlashErrorKind),
    /// The flash itself.
    Refused(Error),
}

impl NorFlashError for FlashError {
    fn kind(&self) -> NorFlashErrorKind {
        match self {
            Self::Arguments(kind) => *kind,
            Self::Refused(error) => error.kind(),
            Self::Unreadable => NorFlashErrorKind::Other,
        }
    }
}

impl ErrorType for BoardFlash {
    type Error = FlashError;
}

impl ReadNorFlash for BoardFlash {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), FlashError> {
        check_read(self, offset, bytes.len()).map_err(FlashError::Arguments)?;
        self.pet();
        UNREADABLE.store(false, Relaxed);
        self.flash.blocking_read(BANK_AT + offset, bytes).map_err(FlashError::Refused)?;
        // The NMI has come by here, if it comes.
        cortex_m::asm::dsb();
        cortex_m::asm::isb();
        if UNREADABLE.load(Relaxed) { Err(FlashError::Unreadable) } else { Ok(()) }
    }

    fn capacity(&self) -> usize {
        LAYOUT.bank_bytes as usize
    }
}

impl NorFlash for BoardFlash {
    const WRITE_SIZE: usize = WRITE_SIZE;
    const ERASE_SIZE: usize = LAYOUT.page_bytes as usize;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), FlashError> {
        check_erase(self, from, to).map_err(FlashError::Arguments)?;
        for page in (BANK_AT + from..BANK_AT + to).step_by(Self::ERASE_SIZE) {
            self.pet();
            let erased = self.flash.blocking_erase(page, page + LAYOUT.page_bytes);
            erased.map_err(FlashError::Refused)?;
        }
        Ok(())
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), FlashError> {
        check_write(self, offset, bytes.len()).map_err(FlashError::Arguments)?;
        self.pet();
        self.flash.blocking_write(BANK_AT + offset, bytes).map_err(FlashError::Refused)
    }
}

// SAFETY: touches registers of the flash alone, and a flag; or nothing else runs any more.
#[exception]
unsafe fn NonMaskableInt() {
    if pac::RCC.cifr().read().cssf() {
        crystal_failed();
    }
    let register = pac::FLASH.eccr();
    let state = register.read();
    // In bank 1 it would be code that is broken.
    if !state.eccd() || !state.bk_ecc() {
        wait_for_reset();
    }
    register.modify(|w| w.set_eccd(true));
    UNREADABLE.store(true, Relaxed);
}
