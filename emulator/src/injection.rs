//! Faults that tests make in a board that runs.

use unicorn_engine::RegisterARM;

use crate::core::exceptions::put;
use crate::failure::Failure;
use crate::machine::Machine;
use crate::memory_map::{BANK_BYTES, FLASH_START};
use crate::registers::{MS, Time};

/// An instruction that does nothing, and a jump to it.
const ENDLESS_LOOP: [u8; 4] = [0x00, 0xBF, 0xFD, 0xE7];
/// The upper byte of an instruction that is defined to be none.
const UNDEFINED: u8 = 0xDE;
/// Longest wait for a moment.
const WAIT: Time = 100 * MS;

impl Machine {
    /// Runs until just so many exceptions are active; whether it came to that.
    ///
    /// # Errors
    /// The image did what is not modelled.
    pub fn run_to_depth(&mut self, depth: usize) -> Result<bool, Failure> {
        let end = self.board().now + WAIT;
        while self.board().now < end {
            if self.board().nvic.depth() == depth {
                return Ok(true);
            }
            self.step(end)?;
        }
        Ok(false)
    }

    /// Masks all interrupts that can be masked, or no longer.
    ///
    /// # Errors
    /// The engine does not take it.
    pub fn mask_interrupts(&mut self, masked: bool) -> Result<(), Failure> {
        put(&mut self.engine, RegisterARM::PRIMASK, u32::from(masked))
    }

    /// Has the thread loop for ever; interrupts go on.
    ///
    /// # Errors
    /// The image has no such loop, or it runs no thread.
    pub fn hang_thread(&mut self) -> Result<(), Failure> {
        self.divert_thread(|four| four == ENDLESS_LOOP)
    }

    /// Has the thread execute what is no instruction, as a panic does at its end.
    ///
    /// # Errors
    /// The image has none, or it runs no thread.
    pub fn crash_thread(&mut self) -> Result<(), Failure> {
        self.divert_thread(|four| four[1] == UNDEFINED)
    }

    /// Has the thread go on where the code is like this.
    fn divert_thread(&mut self, is_there: impl Fn(&[u8]) -> bool) -> Result<(), Failure> {
        let thread = self.run_to_depth(0)?;
        let found = {
            let board = self.board();
            let mut places = board.flash.bytes[..BANK_BYTES].windows(4).step_by(2);
            places.position(is_there)
        };
        let at = found.filter(|_| thread);
        let at = at.ok_or_else(|| Failure::Core("no such code for the thread".to_owned()))?;
        self.wake();
        put(&mut self.engine, RegisterARM::PC, FLASH_START + 2 * at as u32 + 1)
    }
}

impl Machine {
    /// The instruction that comes next.
    pub fn pc(&self) -> u32 {
        crate::core::exceptions::get(&self.engine, RegisterARM::PC).unwrap_or(0)
    }
}
