//! DMA1 and its request multiplexer: bytes between the memory and a block, no processor in between.

use super::{Access, Level};
use crate::failure::Refusal;

/// Channels of DMA1.
const CHANNELS: usize = 8;
const ENABLE: u32 = 1;
const CIRCULAR: u32 = 1 << 5;
const FROM_MEMORY: u32 = 1 << 4;
const MEMORY_INCREMENTS: u32 = 1 << 7;
/// Increments of the block's address, wider words, memory to memory.
const NOT_MODELLED: u32 = 1 << 6 | 0xF << 8 | 1 << 14;

/// A channel.
#[derive(Clone, Copy, Debug, Default)]
struct Channel {
    control: u32,
    left: u32,
    of: u32,
    block: u32,
    memory: u32,
    /// Bytes moved since it was enabled.
    moved: u32,
    request: u32,
}

/// DMA1 with its multiplexer.
#[derive(Clone, Debug, Default)]
pub struct Dma {
    channels: [Channel; CHANNELS],
    flags: u32,
}

/// Flags of a channel: half, complete; in its four bits with the one that sums them up.
const COMPLETE: u32 = 1 << 1;
const HALF: u32 = 1 << 2;

impl Dma {
    /// Whether the interrupt of a channel, from 0 on, is up.
    pub fn level(&self, channel: usize) -> Level {
        let flags = self.flags >> (4 * channel);
        flags & self.channels[channel].control & (COMPLETE | HALF) != 0
    }

    /// The address of the memory for the next byte of a request, if a channel serves it.
    pub fn serves(&self, request: u32, from_memory: bool) -> Option<u32> {
        self.serving(request, from_memory).map(|index| {
            let channel = &self.channels[index];
            let step = if channel.control & MEMORY_INCREMENTS != 0 { channel.moved } else { 0 };
            channel.memory + step
        })
    }

    fn serving(&self, request: u32, from_memory: bool) -> Option<usize> {
        self.channels.iter().position(|channel| {
            channel.request == request
                && channel.control & ENABLE != 0
                && channel.left > 0
                && (channel.control & FROM_MEMORY != 0) == from_memory
        })
    }

    /// A byte of this request was moved.
    pub fn moved(&mut self, request: u32, from_memory: bool) {
        let Some(index) = self.serving(request, from_memory) else { return };
        let channel = &mut self.channels[index];
        channel.left -= 1;
        channel.moved += 1;
        if channel.left == channel.of - channel.of / 2 - channel.of % 2 {
            self.flags |= HALF << (4 * index);
        }
        if channel.left == 0 {
            self.flags |= COMPLETE << (4 * index);
            if channel.control & CIRCULAR != 0 {
                (channel.left, channel.moved) = (channel.of, 0);
            }
        }
    }

    /// A register of DMA1.
    ///
    /// # Errors
    /// None of those modelled.
    pub fn read(&self, offset: u32) -> Access<u32> {
        match offset {
            0x00 => {
                let any = |n: usize| u32::from(self.flags >> (4 * n) & 0xE != 0) << (4 * n);
                Ok((0..CHANNELS).fold(self.flags, |flags, n| flags | any(n)))
            }
            0x08..0xA8 => {
                let channel = &self.channels[(offset as usize - 8) / 20];
                match (offset - 8) % 20 {
                    0 => Ok(channel.control),
                    4 => Ok(channel.left),
                    8 => Ok(channel.block),
                    12 => Ok(channel.memory),
                    _ => Err(Refusal::NotModelled),
                }
            }
            _ => Err(Refusal::NotModelled),
        }
    }

    /// The same, written.
    ///
    /// # Errors
    /// None of those modelled, or a way of moving that is not.
    pub fn write(&mut self, offset: u32, value: u32) -> Access<()> {
        match offset {
            0x04 => {
                let all = |n: usize| if value >> (4 * n) & 1 == 1 { 0xF << (4 * n) } else { 0 };
                self.flags &= !(0..CHANNELS).fold(value, |bits, n| bits | all(n));
            }
            0x08..0xA8 => {
                self.channels[(offset as usize - 8) / 20].write((offset - 8) % 20, value)?
            }
            _ => return Err(Refusal::NotModelled),
        }
        Ok(())
    }

    /// A register of the multiplexer: a request for each channel.
    ///
    /// # Errors
    /// None of those modelled.
    pub fn write_request(&mut self, offset: u32, value: u32) -> Access<()> {
        let index = offset as usize / 4;
        match self.channels.get_mut(index) {
            // Events for other channels, which none listens to, may be on.
            Some(channel) if value & !(0x7F | 1 << 9) == 0 => channel.request = value & 0x7F,
            Some(_) => return Err(Refusal::Value(value)),
            None => return Err(Refusal::NotModelled),
        }
        Ok(())
    }

    /// The same, read.
    ///
    /// # Errors
    /// None of those modelled.
    pub fn read_request(&self, offset: u32) -> Access<u32> {
        self.channels.get(offset as usize / 4).map(|c| c.request).ok_or(Refusal::NotModelled)
    }
}

impl Channel {
    fn write(&mut self, register: u32, value: u32) -> Access<()> {
        let is_on = self.control & ENABLE != 0;
        match register {
            0 if value & ENABLE != 0 && value & NOT_MODELLED != 0 => {
                return Err(Refusal::Value(value));
            }
            0 => {
                if value & !self.control & ENABLE != 0 {
                    (self.of, self.moved) = (self.left, 0);
                }
                self.control = value;
            }
            // A channel that is on keeps what it has.
            4 | 8 | 12 if is_on => {}
            4 => self.left = value & 0xFFFF,
            8 => self.block = value,
            12 => self.memory = value,
            _ => return Err(Refusal::NotModelled),
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ring_tells_its_middle_and_its_end_and_begins_anew() {
        let mut dma = Dma::default();
        dma.write_request(0, 34).unwrap();
        for (offset, value) in [(0x0C, 4), (0x10, 0x4000_8024), (0x14, 0x2000_0000)] {
            dma.write(offset, value).unwrap();
        }
        dma.write(0x08, 1 | 1 << 1 | 1 << 2 | 1 << 5 | 1 << 7).unwrap();
        let mut seen = Vec::new();
        for _ in 0..5 {
            seen.push((dma.serves(34, false).unwrap(), dma.read(0x00).unwrap()));
            dma.moved(34, false);
        }
        let at = |offset: u32, flags: u32| (0x2000_0000 + offset, flags);
        assert_eq!(seen, [at(0, 0), at(1, 0), at(2, 0b101), at(3, 0b101), at(0, 0b111)]);
        assert_eq!(dma.read(0x0C).unwrap(), 3);
        dma.write(0x04, 1 << 1 | 1 << 2).unwrap();
        assert!(!dma.level(0));
    }
}
