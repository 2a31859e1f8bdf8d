//! The pins of one port: modes, levels, alternate functions.

use super::Access;
use crate::failure::Refusal;

/// What a pin is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pin {
    /// Nothing drives it.
    Floating,
    /// Driven low or high.
    Output(bool),
    /// Given to a block, by the number of its function.
    Alternate(u32),
}

/// The registers of a port.
#[derive(Clone, Debug)]
pub struct Gpio {
    mode: u32,
    output_type: u32,
    speed: u32,
    pull: u32,
    output: u32,
    alternate: [u32; 2],
    /// What the wires outside pull the pins to, bit by bit.
    pub wires: u32,
}

impl Gpio {
    /// A port after a reset; A and B have the debugger's pins.
    pub fn new(port: usize) -> Self {
        let (mode, speed, pull) = match port {
            0 => (0xABFF_FFFF, 0x0C00_0000, 0x6400_0000),
            1 => (0xFFFF_FEBF, 0, 0x0000_0100),
            _ => (0xFFFF_FFFF, 0, 0),
        };
        // PC5 and PC8: the emergency stop is not pressed, the amplifiers have power.
        let wires = if port == 2 { 1 << 5 | 1 << 8 } else { 0 };
        Self { mode, output_type: 0, speed, pull, output: 0, alternate: [0; 2], wires }
    }

    /// What a pin is.
    pub fn pin(&self, number: usize) -> Pin {
        match self.mode >> (2 * number) & 3 {
            1 => Pin::Output(self.output >> number & 1 == 1),
            2 => Pin::Alternate(self.alternate[number / 8] >> (4 * (number % 8)) & 0xF),
            _ => Pin::Floating,
        }
    }

    /// Whether a pin is an analog input, which nothing in the chip loads.
    pub fn is_analog(&self, number: usize) -> bool {
        (self.mode >> (2 * number) & 3, self.pull >> (2 * number) & 3) == (3, 0)
    }

    /// Resistors within the chip, two bits a pin: none, up, down.
    pub fn pulls(&self) -> u32 {
        self.pull
    }

    /// The levels that the input register shows: what a pin drives, else its wire.
    fn input(&self) -> u32 {
        let level = |number: usize| match self.mode >> (2 * number) & 3 {
            0 => self.wires >> number & 1,
            1 => self.output >> number & 1,
            _ => 0,
        };
        (0..16).map(|number| level(number) << number).sum()
    }

    /// A register.
    ///
    /// # Errors
    /// None of those modelled.
    pub fn read(&self, offset: u32) -> Access<u32> {
        match offset {
            0x00 => Ok(self.mode),
            0x04 => Ok(self.output_type),
            0x08 => Ok(self.speed),
            0x0C => Ok(self.pull),
            0x10 => Ok(self.input()),
            0x14 => Ok(self.output),
            0x20 | 0x24 => Ok(self.alternate[(offset as usize - 0x20) / 4]),
            _ => Err(Refusal::NotModelled),
        }
    }

    /// The same, written.
    ///
    /// # Errors
    /// None of those modelled.
    pub fn write(&mut self, offset: u32, value: u32) -> Access<()> {
        match offset {
            0x00 => self.mode = value,
            0x04 => self.output_type = value,
            0x08 => self.speed = value,
            0x0C => self.pull = value,
            0x14 => self.output = value & 0xFFFF,
            // Of both at once, set wins.
            0x18 => self.output = self.output & !(value >> 16) | value & 0xFFFF,
            0x20 | 0x24 => self.alternate[(offset as usize - 0x20) / 4] = value,
            0x28 => self.output &= !(value & 0xFFFF),
            _ => return Err(Refusal::NotModelled),
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn after_a_reset_no_pin_drives_the_converter() {
        for number in 10..16 {
            assert_eq!(Gpio::new(1).pin(number), Pin::Floating);
        }
    }

    #[test]
    fn set_wins_over_reset_in_one_write() {
        let mut port = Gpio::new(2);
        port.write(0x00, 1).unwrap();
        port.write(0x18, 0x0001_0001).unwrap();
        assert_eq!(port.pin(0), Pin::Output(true));
        port.write(0x18, 0x0001_0000).unwrap();
        assert_eq!(port.pin(0), Pin::Output(false));
    }
}
