//! Which register block an address belongs to, and accesses to it.

use crate::board::Board;
use crate::failure::Refusal;
use crate::memory_map::{BANK_BYTES, BANK2_START};
use crate::registers::Access;
use crate::registers::gpio::Gpio;
use crate::registers::lpuart::Lpuart;
use crate::registers::spi::Spi;
use crate::registers::timer::Timer;

/// A register block that is modelled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Block {
    Encoder(usize),
    Tim4,
    Tim5,
    Tim6,
    Lptim1,
    Watchdog,
    Spi2,
    Power,
    Lpuart1,
    Dma1,
    DmaRequests,
    Rcc,
    Flash,
    Port(usize),
    Random,
    SystemConfig,
    Adc1,
}

/// Blocks by their addresses, with register and bit of their clock in RCC; 0 where they need none.
const BLOCKS: [(u32, Block, (u32, u32)); 24] = [
    (0x4000_0000, Block::Encoder(0), (0x58, 0)),
    (0x4000_0400, Block::Encoder(1), (0x58, 1)),
    (0x4001_2C00, Block::Encoder(2), (0x60, 11)),
    (0x4000_0800, Block::Tim4, (0x58, 2)),
    (0x4000_0C00, Block::Tim5, (0x58, 3)),
    (0x4000_1000, Block::Tim6, (0x58, 4)),
    (0x4000_3000, Block::Watchdog, (0, 0)),
    (0x4000_3800, Block::Spi2, (0x58, 14)),
    (0x4000_7000, Block::Power, (0x58, 28)),
    (0x4000_7C00, Block::Lptim1, (0x58, 31)),
    (0x4000_8000, Block::Lpuart1, (0x5C, 0)),
    (0x4002_0000, Block::Dma1, (0x48, 0)),
    (0x4002_0800, Block::DmaRequests, (0x48, 2)),
    (0x4002_1000, Block::Rcc, (0, 0)),
    (0x4002_2000, Block::Flash, (0, 0)),
    (0x4800_0000, Block::Port(0), (0x4C, 0)),
    (0x4800_0400, Block::Port(1), (0x4C, 1)),
    (0x4800_0800, Block::Port(2), (0x4C, 2)),
    (0x4800_0C00, Block::Port(3), (0x4C, 3)),
    (0x4800_1000, Block::Port(4), (0x4C, 4)),
    (0x4800_1400, Block::Port(5), (0x4C, 5)),
    (0x4001_0000, Block::SystemConfig, (0x60, 0)),
    (0x5000_0000, Block::Adc1, (0x4C, 13)),
    (0x5006_0800, Block::Random, (0x4C, 26)),
];
/// DBGMCU_CR: what a debugger keeps running; none is there.
const DEBUG: u32 = 0xE004_2004;
const BLOCK_BYTES: u32 = 0x400;
/// Registers of resets stand so far before those of clocks.
const RESETS_BEFORE_CLOCKS: u32 = 0x20;

impl Board {
    /// Reads registers or bank 2.
    ///
    /// # Errors
    /// Why there is no answer.
    pub fn read(&mut self, address: u32, bytes: usize) -> Access<u64> {
        if let Some(offset) = address.checked_sub(BANK2_START).filter(|o| *o < BANK_BYTES as u32) {
            let value = self.flash.read_bank2(offset as usize, bytes, self.now);
            self.now += std::mem::take(&mut self.flash.stall);
            self.set_lines();
            self.stop_if_pending();
            return Ok(value);
        }
        let word = self.read_word(address & !3, bytes)?;
        let shifted = word >> (8 * (address & 3));
        let mask = if bytes >= 4 { u32::MAX } else { (1 << (8 * bytes)) - 1 };
        Ok(u64::from(shifted & mask))
    }

    fn read_word(&mut self, address: u32, bytes: usize) -> Access<u32> {
        match address {
            0xE000_E100..0xE000_E500 => return self.nvic.read(address - 0xE000_E100),
            0xE000_ED00..0xE000_EF40 => return self.system.read(address, &self.nvic),
            DEBUG => return Ok(self.debug),
            _ => {}
        }
        self.catch_up();
        let (block, offset) = self.located(address)?;
        let value = match block {
            Block::Encoder(i) => self.encoders[i].read(offset),
            Block::Tim4 => self.tim4.read(offset),
            Block::Tim5 => self.tim5.read(offset),
            Block::Tim6 => self.tim6.read(offset),
            Block::Lptim1 => self.lptim1.read(offset),
            Block::Watchdog => self.watchdog.read(offset),
            Block::Spi2 => self.spi.read(offset, bytes),
            Block::Power => self.power.read(offset),
            Block::Lpuart1 => self.lpuart.read(offset),
            Block::Dma1 => self.dma.read(offset),
            Block::DmaRequests => self.dma.read_request(offset),
            Block::Rcc => self.rcc.read(offset, self.now),
            Block::Flash => self.flash.read(offset),
            Block::Port(port) => self.gpio[port].read(offset),
            Block::Adc1 => self.adc.read(offset, self.now),
            Block::Random => self.random.read(offset),
            // Bank 1 comes first.
            Block::SystemConfig if offset == 0 => Ok(0),
            Block::SystemConfig => Err(Refusal::NotModelled),
        };
        self.set_lines();
        value
    }

    /// Writes registers or bank 2.
    ///
    /// # Errors
    /// Why it is not taken.
    pub fn write(&mut self, address: u32, bytes: usize, value: u32) -> Access<()> {
        let done = self.write_somewhere(address, bytes, value);
        self.set_lines();
        self.stop_if_pending();
        done
    }

    fn write_somewhere(&mut self, address: u32, bytes: usize, value: u32) -> Access<()> {
        if let Some(offset) = address.checked_sub(BANK2_START).filter(|o| *o < BANK_BYTES as u32) {
            self.flash.advance(self.now);
            return self.flash.write_bank2(offset as usize, bytes, value, self.now);
        }
        match address {
            0xE000_E100..0xE000_E500 => {
                return self.nvic.write(address - 0xE000_E100, bytes, value);
            }
            0xE000_ED00..0xE000_EF40 => {
                return self.system.write(address, bytes, value, &mut self.nvic);
            }
            DEBUG => {
                self.debug = value;
                return Ok(());
            }
            _ => {}
        }
        self.catch_up();
        let (block, offset) = self.located(address)?;
        self.write_block(block, offset, bytes, value)
    }

    fn write_block(&mut self, block: Block, offset: u32, bytes: usize, value: u32) -> Access<()> {
        let now = self.now;
        match block {
            Block::Encoder(i) => self.encoders[i].write(offset, value, now),
            Block::Tim4 => {
                let done = self.tim4.write(offset, value, now);
                self.pass_load();
                done
            }
            Block::Tim5 => self.tim5.write(offset, value, now),
            Block::Tim6 => self.tim6.write(offset, value, now),
            Block::Lptim1 => self.lptim1.write(offset, value),
            Block::Watchdog => self.watchdog.write(offset, value, now),
            Block::Spi2 => self.write_spi(offset, bytes, value),
            Block::Power => self.power.write(offset, value),
            Block::Lpuart1 => self.write_lpuart(offset, value),
            Block::Dma1 => self.dma.write(offset, value),
            Block::DmaRequests => self.dma.write_request(offset, value),
            Block::Rcc => self.write_rcc(offset, value),
            Block::Flash => {
                let done = self.flash.write(offset, value, now);
                self.clocks_changed();
                done
            }
            Block::Port(port) => {
                let done = self.gpio[port].write(offset, value);
                self.pins_changed();
                done
            }
            Block::Adc1 => self.adc.write(offset, value, now),
            Block::Random => self.random.write(offset, value),
            Block::SystemConfig => Err(Refusal::NotModelled),
        }
    }

    /// Data take the pins.
    fn write_spi(&mut self, offset: u32, bytes: usize, value: u32) -> Access<()> {
        if offset == 0x0C {
            self.spi_pins()?;
        }
        self.spi.write(offset, bytes, value, self.now)
    }

    /// Switching it on takes the pins.
    fn write_lpuart(&mut self, offset: u32, value: u32) -> Access<()> {
        if offset == 0 && value & 1 == 1 {
            self.given(0, &[2, 3], 12)?;
        }
        self.lpuart.write(offset, value, self.now)
    }

    fn write_rcc(&mut self, offset: u32, value: u32) -> Access<()> {
        let reset = self.rcc.write(offset, value, self.now)?;
        self.clocks_changed();
        // More than 150 MHz need the higher voltage and four wait states.
        if self.rcc.core_hz() > 150_000_000 && (!self.power.boosted() || self.flash.timing().0 < 4)
        {
            return Err(Refusal::Value(value));
        }
        let Some((register, bits)) = reset.filter(|(_, bits)| *bits != 0) else { return Ok(()) };
        for (_, block, (clock, bit)) in BLOCKS {
            if clock == register + RESETS_BEFORE_CLOCKS && bits >> bit & 1 == 1 {
                self.reset_block(block)?;
            }
        }
        Ok(())
    }

    fn reset_block(&mut self, block: Block) -> Access<()> {
        match block {
            Block::Encoder(i) => self.encoders[i] = Timer::new(if i == 0 { 32 } else { 16 }),
            Block::Tim4 => self.tim4 = Timer::with_output(16),
            Block::Tim5 => self.tim5 = Timer::new(32),
            Block::Tim6 => self.tim6 = Timer::new(16),
            Block::Lptim1 => self.lptim1 = Default::default(),
            Block::Spi2 => self.spi = Spi::default(),
            Block::Lpuart1 => self.lpuart = Lpuart::new(),
            Block::Dma1 | Block::DmaRequests => self.dma = Default::default(),
            Block::Port(port) => {
                self.gpio[port] = Gpio::new(port);
                self.pins_changed();
            }
            Block::Adc1 => self.adc = Default::default(),
            Block::Power => self.power = Default::default(),
            Block::Random | Block::SystemConfig => {}
            Block::Watchdog | Block::Rcc | Block::Flash => return Err(Refusal::NotModelled),
        }
        Ok(())
    }

    fn located(&self, address: u32) -> Access<(Block, u32)> {
        let found = BLOCKS.iter().find(|(start, ..)| {
            address.checked_sub(*start).is_some_and(|offset| offset < BLOCK_BYTES)
        });
        let (start, block, clock) = *found.ok_or(Refusal::NotModelled)?;
        match clock == (0, 0) || self.rcc.is_on(clock) {
            true => Ok((block, address - start)),
            false => Err(Refusal::NoClock),
        }
    }

    /// Has the engine stop where an exception may come in or the DMA may move a byte.
    fn stop_if_pending(&mut self) {
        if self.nvic.next().is_some() || self.system.reset || self.lpuart.asks_dma() {
            self.stop_at = 0;
        }
        self.stop_at = self.stop_at.min(self.next_event());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::memory_map::FLASH_BYTES;
    use crate::plant::Still;

    const RCC: u32 = 0x4002_1000;

    fn board() -> Board {
        Board::new(vec![0xFF; FLASH_BYTES], Box::new(Still))
    }

    #[test]
    fn what_is_not_modelled_has_no_clock_or_no_pins_is_refused() {
        let mut board = board();
        assert_eq!(board.read(0x4000_4400, 4), Err(Refusal::NotModelled), "USART2");
        assert_eq!(board.read(0x4000_3800, 4), Err(Refusal::NoClock), "SPI2");
        board.write(RCC + 0x58, 4, 1 << 14).unwrap();
        assert_eq!(board.read(0x4000_3800, 4), Ok(0));
        assert_eq!(board.write(0x4000_380C, 1, 0x55), Err(Refusal::Pins));
    }

    #[test]
    fn the_clock_of_170_mhz_takes_boost_and_wait_states() {
        for (boost, wait_states) in [(true, 4), (false, 4), (true, 3)] {
            let mut board = board();
            board.write(RCC + 0x58, 4, 1 << 28).unwrap();
            board.write(0x4000_7080, 4, if boost { 0 } else { 1 << 8 }).unwrap();
            board.write(0x4002_2000, 4, 0x600 | wait_states).unwrap();
            // 24 MHz / 6 * 85 / 2.
            board.write(RCC + 0x0C, 4, 0x0100_5553).unwrap();
            let done = board.write(RCC + 0x08, 4, 3);
            assert_eq!(done.is_ok(), boost && wait_states == 4, "{boost} {wait_states}");
            assert!(board.rcc.is_full_speed());
        }
    }
}
