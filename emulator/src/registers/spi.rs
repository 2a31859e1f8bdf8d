//! SPI2 as a master of eight bits: two queues of four bytes and a shift register between them.

use std::collections::VecDeque;

use super::{Access, Time};
use crate::failure::Refusal;

/// Bytes of a queue.
const ROOM: usize = 4;
const ENABLE: u32 = 1 << 6;
const MASTER: u32 = 1 << 2;
const SOFTWARE_SELECT: u32 = 1 << 9 | 1 << 8;
const RISING_IDLE: u32 = 1 << 1;
const SECOND_EDGE: u32 = 1;
/// Two wires, least significant bit first, checksums.
const NOT_MODELLED: u32 = 0xFC80;
const OVERRUN: u32 = 1 << 6;

/// The shift register's other end.
pub trait Wire {
    /// A byte goes out at this time, and one comes in.
    fn exchange(&mut self, byte: u8, falling_edge: bool, bit: Time) -> u8;
}

/// The block.
#[derive(Clone, Debug, Default)]
pub struct Spi {
    control: u32,
    control2: u32,
    to_send: VecDeque<u8>,
    received: VecDeque<u8>,
    /// The byte on the wire, and when its last bit is through.
    on_wire: Option<(u8, Time)>,
    overrun: bool,
}

impl Spi {
    /// Cycles of a bit.
    fn bit(&self) -> Time {
        2 << (self.control >> 3 & 7)
    }

    /// Takes the wire to a point of time.
    pub fn advance(&mut self, now: Time, wire: &mut impl Wire) {
        while let Some((byte, done)) = self.on_wire.filter(|(_, done)| *done <= now) {
            let falls = (self.control & SECOND_EDGE != 0) != (self.control & RISING_IDLE != 0);
            let answer = wire.exchange(byte, falls, self.bit());
            match self.received.len() {
                ROOM => self.overrun = true,
                _ => self.received.push_back(answer),
            }
            self.on_wire = self.to_send.pop_front().map(|next| (next, done + 8 * self.bit()));
        }
    }

    fn status(&mut self) -> u32 {
        let level = |length: usize| length.min(3) as u32;
        let (sending, received) = (level(self.to_send.len()), level(self.received.len()));
        u32::from(received > 0)
            | u32::from(sending <= 2) << 1
            | u32::from(self.overrun) << 6
            | u32::from(self.on_wire.is_some()) << 7
            | received << 9
            | sending << 11
    }

    /// A register; the wire must have been taken to the present.
    ///
    /// # Errors
    /// None of those modelled.
    pub fn read(&mut self, offset: u32, bytes: usize) -> Access<u32> {
        match offset {
            0x00 => Ok(self.control),
            0x04 => Ok(self.control2),
            0x08 => {
                let status = self.status();
                if status & OVERRUN != 0 {
                    // Cleared by reading data, then status.
                    self.overrun = false;
                }
                Ok(status)
            }
            0x0C => {
                let mut byte = || u32::from(self.received.pop_front().unwrap_or(0));
                Ok(if bytes == 1 { byte() } else { byte() | byte() << 8 })
            }
            0x1C => Ok(0),
            _ => Err(Refusal::NotModelled),
        }
    }

    /// The same, written; data by the width of the access, 1 or 2 bytes.
    ///
    /// # Errors
    /// None of those modelled, or a mode that is not.
    pub fn write(&mut self, offset: u32, bytes: usize, value: u32, now: Time) -> Access<()> {
        match offset {
            0x00 if value & NOT_MODELLED != 0 => return Err(Refusal::Value(value)),
            0x00 => self.control = value,
            // Eight bits, and a byte is enough to tell.
            0x04 if value & 0xFFFF & !(1 << 12 | 0x0F00 | 1 << 2 | 3) == 0 => self.control2 = value,
            0x0C if bytes <= 2 => {
                self.check_mode()?;
                for byte in value.to_le_bytes().into_iter().take(bytes) {
                    self.send(byte, now)?;
                }
            }
            // Sound is off.
            0x1C if value == 0 => {}
            _ => return Err(Refusal::Value(value)),
        }
        Ok(())
    }

    fn check_mode(&self) -> Access<()> {
        let is_master =
            self.control & (ENABLE | MASTER | SOFTWARE_SELECT) == ENABLE | MASTER | SOFTWARE_SELECT;
        let takes_bytes = self.control2 & 0x1F00 == 0x1700;
        match is_master && takes_bytes {
            true => Ok(()),
            false => Err(Refusal::Value(self.control << 16 | self.control2)),
        }
    }

    fn send(&mut self, byte: u8, now: Time) -> Access<()> {
        match self.on_wire {
            None => self.on_wire = Some((byte, now + 8 * self.bit())),
            Some(_) if self.to_send.len() < ROOM => self.to_send.push_back(byte),
            // The program did not look whether there was room.
            Some(_) => return Err(Refusal::Value(u32::from(byte))),
        }
        Ok(())
    }
}
