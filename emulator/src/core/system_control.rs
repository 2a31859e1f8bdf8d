//! The core's own registers around 0xE000ED00: vectors, priorities, faults, floating point.

use super::nvic::{Nvic, PEND_SV};
use crate::failure::Refusal;
use crate::registers::Access;

/// The part number of a Cortex-M4, r0p1.
const CPUID: u32 = 0x410F_C241;
const RESET_KEY: u32 = 0x05FA;

/// The registers.
#[derive(Clone, Debug, Default)]
pub struct SystemControl {
    /// Where the vectors are.
    pub vectors: u32,
    /// A reset was asked for.
    pub reset: bool,
    /// Full access to the floating-point unit was given.
    pub floating_point: bool,
    /// Why there was a fault.
    pub fault_status: u32,
    access: u32,
    handlers: u32,
    debug_monitor: u32,
}

impl SystemControl {
    /// A register, by its address.
    ///
    /// # Errors
    /// None of those modelled.
    pub fn read(&self, address: u32, nvic: &Nvic) -> Access<u32> {
        match address {
            0xE000_ED00 => Ok(CPUID),
            0xE000_ED04 => Ok(nvic.running() as u32),
            0xE000_ED08 => Ok(self.vectors),
            0xE000_ED0C => Ok(0xFA05_0000 | u32::from(nvic.group) << 8),
            // Deep sleep and the like are off.
            0xE000_ED10 => Ok(0),
            0xE000_ED24 => Ok(self.handlers),
            0xE000_ED28 => Ok(self.fault_status),
            0xE000_ED88 => Ok(self.access),
            // Automatic and lazy saving of the floating-point registers, as after a reset.
            0xE000_EF34 => Ok(0xC000_0000),
            // No debugger.
            0xE000_EDF0 => Ok(0),
            0xE000_EDFC => Ok(self.debug_monitor),
            _ => Err(Refusal::NotModelled),
        }
    }

    /// The same, written.
    ///
    /// # Errors
    /// None of those modelled, or a value that asks for what is not.
    pub fn write(&mut self, address: u32, bytes: usize, value: u32, nvic: &mut Nvic) -> Access<()> {
        match address {
            0xE000_ED04 if value & !(1 << 28 | 1 << 27) == 0 => match value >> 27 {
                0b10 => nvic.pend(PEND_SV),
                _ => nvic.unpend(PEND_SV),
            },
            0xE000_ED08 => self.vectors = value,
            0xE000_ED0C if value >> 16 == RESET_KEY => {
                nvic.group = (value >> 8 & 7) as u8;
                self.reset = value & 1 << 2 != 0;
            }
            0xE000_ED10 if value == 0 => {}
            0xE000_ED18..0xE000_ED24 => {
                for (index, byte) in value.to_le_bytes().into_iter().take(bytes).enumerate() {
                    nvic.set_core_priority(4 + (address - 0xE000_ED18) as usize + index, byte);
                }
            }
            0xE000_ED24 if value & !0x0007_0000 == 0 => self.handlers = value,
            0xE000_ED88 => {
                self.access = value;
                self.floating_point = value >> 20 & 0xF == 0xF;
            }
            0xE000_EDFC => self.debug_monitor = value,
            _ => return Err(Refusal::Value(value)),
        }
        Ok(())
    }
}
