//! A line on which bytes are flipped, lost and doubled.

use std::collections::VecDeque;

use random_motions::Rng;

/// One way of the line.
#[derive(Debug)]
pub struct NoisyLine {
    bytes: VecDeque<u8>,
    rng: Rng,
    bytes_per_error: u32,
    /// Bytes that went in.
    pub carried: u64,
    /// Of those, broken.
    pub broken: u64,
}

impl NoisyLine {
    /// A line that breaks one byte in so many.
    pub fn new(bytes_per_error: u32, seed: u64) -> Self {
        let rng = Rng::new(seed);
        Self { bytes: VecDeque::new(), rng, bytes_per_error, carried: 0, broken: 0 }
    }

    /// Puts a byte in.
    pub fn push(&mut self, byte: u8) {
        self.carried += 1;
        if self.rng.below(self.bytes_per_error) > 0 {
            self.bytes.push_back(byte);
            return;
        }
        self.broken += 1;
        match self.rng.below(4) {
            0 => {}
            1 => self.bytes.extend([byte, byte]),
            2 => self.bytes.push_back(self.rng.word() as u8),
            _ => self.bytes.push_back(byte ^ 1 << self.rng.below(8)),
        }
    }

    /// What comes out.
    pub fn pop(&mut self) -> Option<u8> {
        self.bytes.pop_front()
    }
}
