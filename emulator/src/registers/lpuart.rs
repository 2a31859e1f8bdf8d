//! LPUART1: the serial line, byte by byte as fast as it is set.

use std::collections::VecDeque;

use super::{Access, Level, Time};
use crate::failure::Refusal;

/// Requests to the DMA (RM0440, table 91).
pub const RECEIVE_REQUEST: u32 = 34;
/// As above.
pub const SEND_REQUEST: u32 = 35;
/// Start, eight bits, stop.
const BITS: u64 = 10;

const ENABLE: u32 = 1;
const RECEIVE: u32 = 1 << 2;
const SEND: u32 = 1 << 3;
/// Queues of eight bytes each way.
const QUEUES: u32 = 1 << 29;
const ROOM: usize = 8;
/// Parity, nine bits, wake-up by address: of CR1.
const NOT_MODELLED: u32 = 1 << 28 | 1 << 12 | 1 << 10;
const DMA_RECEIVES: u32 = 1 << 6;
const DMA_SENDS: u32 = 1 << 7;

const OVERRUN: u32 = 1 << 3;
const IDLE: u32 = 1 << 4;
const RECEIVED: u32 = 1 << 5;
const SENT: u32 = 1 << 6;
const EMPTY: u32 = 1 << 7;

/// The block, and what is on its two wires.
#[derive(Clone, Debug, Default)]
pub struct Lpuart {
    control: [u32; 3],
    divider: u32,
    flags: u32,
    received: VecDeque<u8>,
    to_send: VecDeque<u8>,
    on_wire: Option<(u8, Time)>,
    next_byte: Option<Time>,
    idle_at: Option<Time>,
    /// Bytes of the host that are on their way.
    pub incoming: VecDeque<u8>,
    /// Bytes for the host.
    pub outgoing: Vec<u8>,
    /// Bytes that came while the last one had not been fetched.
    pub overruns: u64,
}

impl Lpuart {
    /// A block after a reset.
    pub fn new() -> Self {
        Self { flags: SENT, ..Self::default() }
    }

    /// Cycles of a byte; `None` before the baud rate is set.
    fn byte(&self) -> Option<Time> {
        (self.divider > 0).then(|| BITS * u64::from(self.divider) / 256)
    }

    /// Whether its interrupt is up.
    pub fn level(&self) -> Level {
        let by_flag = self.status() & self.control[0] & (IDLE | RECEIVED | SENT | EMPTY) != 0;
        let with_error = RECEIVED | 1;
        by_flag
            || self.flags & OVERRUN != 0
                && (self.control[2] & 1 | self.control[0] & with_error) != 0
    }

    /// Bytes for which there is room each way.
    fn room(&self) -> usize {
        if self.control[0] & QUEUES != 0 { ROOM } else { 1 }
    }

    /// Flags, with those that the queues make.
    fn status(&self) -> u32 {
        let received = if self.received.is_empty() { 0 } else { RECEIVED };
        let empty = if self.to_send.len() < self.room() { EMPTY } else { 0 };
        self.flags | received | empty
    }

    fn receives(&self) -> bool {
        self.control[0] & (ENABLE | RECEIVE) == ENABLE | RECEIVE
    }

    /// When something comes of itself.
    pub fn next_event(&self) -> Option<Time> {
        [self.next_byte, self.idle_at, self.on_wire.map(|(_, done)| done)]
            .into_iter()
            .flatten()
            .min()
    }

    /// Takes the wires to a point of time.
    pub fn advance(&mut self, now: Time) {
        let Some(byte) = self.byte() else { return };
        if self.next_byte.is_none() && !self.incoming.is_empty() {
            self.next_byte = Some(now + byte);
            self.idle_at = None;
        }
        if self.next_byte.is_some_and(|at| at <= now) {
            self.receive(now, byte);
        }
        if self.idle_at.is_some_and(|at| at <= now) {
            self.idle_at = None;
            self.flags |= IDLE;
        }
        while let Some((sent, done)) = self.on_wire.filter(|(_, done)| *done <= now) {
            self.outgoing.push(sent);
            self.on_wire = self.to_send.pop_front().map(|next| (next, done + byte));
            if self.on_wire.is_none() {
                self.flags |= SENT;
            }
        }
    }

    fn receive(&mut self, now: Time, byte: Time) {
        let data = self.incoming.pop_front();
        self.next_byte = (!self.incoming.is_empty()).then_some(now + byte);
        let Some(data) = data.filter(|_| self.receives()) else { return };
        if self.received.len() == self.room() {
            self.flags |= OVERRUN;
            self.overruns += 1;
        } else {
            self.received.push_back(data);
        }
        if self.next_byte.is_none() {
            self.idle_at = Some(now + byte);
        }
    }

    /// The byte that the DMA is to fetch, which thereby is fetched.
    pub fn take_by_dma(&mut self) -> Option<u8> {
        if self.has_for_dma() { self.received.pop_front() } else { None }
    }

    /// Whether it has a byte for the DMA to fetch.
    pub fn has_for_dma(&self) -> bool {
        self.control[2] & DMA_RECEIVES != 0 && !self.received.is_empty()
    }

    /// Whether it asks the DMA for a byte to send.
    pub fn asks_dma(&self) -> bool {
        self.control[2] & DMA_SENDS != 0 && self.status() & EMPTY != 0 && self.sends()
    }

    fn sends(&self) -> bool {
        self.control[0] & (ENABLE | SEND) == ENABLE | SEND
    }

    /// Takes a byte to send.
    pub fn send(&mut self, byte: u8, now: Time) {
        self.flags &= !SENT;
        match (self.on_wire, self.byte()) {
            (None, Some(time)) => self.on_wire = Some((byte, now + time)),
            _ => self.to_send.push_back(byte),
        }
    }

    /// A register; the wires must have been taken to the present.
    ///
    /// # Errors
    /// None of those modelled.
    pub fn read(&mut self, offset: u32) -> Access<u32> {
        match offset {
            0x00 | 0x04 | 0x08 => Ok(self.control[offset as usize / 4]),
            0x0C => Ok(self.divider),
            0x1C => {
                let enabled = self.control[0] & ENABLE != 0;
                let ready =
                    |bit: u32, flag: u32| u32::from(enabled && self.control[0] & bit != 0) << flag;
                Ok(self.status() | ready(SEND, 21) | ready(RECEIVE, 22))
            }
            0x24 => Ok(u32::from(self.received.pop_front().unwrap_or(0))),
            0x2C => Ok(0),
            _ => Err(Refusal::NotModelled),
        }
    }

    /// The same, written.
    ///
    /// # Errors
    /// None of those modelled, or a mode that is not.
    pub fn write(&mut self, offset: u32, value: u32, now: Time) -> Access<()> {
        match offset {
            0x00 if value & NOT_MODELLED != 0 => return Err(Refusal::Value(value)),
            0x00 | 0x08 => self.control[offset as usize / 4] = value,
            // One stop bit, no swaps, no inversions.
            0x04 if value == 0 => {}
            0x0C => self.divider = value,
            // Requests: what was received is dropped.
            0x18 if value & !0x18 == 0 => self.received.clear(),
            0x20 => self.flags &= !(value & (OVERRUN | IDLE | SENT | 7)),
            0x28 if self.sends() => self.send(value as u8, now),
            // The clock is not divided.
            0x2C if value == 0 => {}
            _ => return Err(Refusal::Value(value)),
        }
        Ok(())
    }
}
