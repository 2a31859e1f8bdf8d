//! A line on which bytes are flipped, lost and doubled.

use std::collections::VecDeque;

use super::dice::Dice;

/// One way of the line.
#[derive(Debug)]
pub struct NoisyLine {
    bytes: VecDeque<u8>,
    dice: Dice,
    bytes_per_error: u32,
    /// Bytes that went in.
    pub carried: u64,
    /// Of those, broken.
    pub broken: u64,
}

impl NoisyLine {
    /// A line that breaks one byte in so many.
    pub fn new(bytes_per_error: u32, seed: u64) -> Self {
        let dice = Dice::new(seed);
        Self { bytes: VecDeque::new(), dice, bytes_per_error, carried: 0, broken: 0 }
    }

    /// Puts a byte in.
    pub fn push(&mut self, byte: u8) {
        self.carried += 1;
        if self.dice.below(self.bytes_per_error) > 0 {
            self.bytes.push_back(byte);
            return;
        }
        self.broken += 1;
        match self.dice.below(4) {
            0 => {}
            1 => self.bytes.extend([byte, byte]),
            2 => self.bytes.push_back(self.dice.word() as u8),
            _ => self.bytes.push_back(byte ^ 1 << self.dice.below(8)),
        }
    }

    /// What comes out.
    pub fn pop(&mut self) -> Option<u8> {
        self.bytes.pop_front()
    }
}
