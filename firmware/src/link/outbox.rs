//! The send buffer: answers always find room, telemetry only where it is free.

use heapless::Deque;

use super::checked::MAX_FRAME_BYTES;

/// Bytes on their way to the line.
#[derive(Debug, Default)]
pub struct Outbox<const BYTES: usize> {
    bytes: Deque<u8, BYTES>,
    dropped: u32,
}

impl<const BYTES: usize> Outbox<BYTES> {
    /// An empty one.
    pub const fn new() -> Self {
        Self { bytes: Deque::new(), dropped: 0 }
    }

    /// Puts an answer's frame in; false if the host has asked more than it has read.
    pub fn push_answer(&mut self, frame: &[u8]) -> bool {
        self.push(frame, 0)
    }

    /// Puts a telemetry record's frame in, or counts it as dropped.
    ///
    /// Room for one answer is always left.
    pub fn push_telemetry(&mut self, frame: &[u8]) {
        if !self.push(frame, MAX_FRAME_BYTES) {
            self.dropped = self.dropped.wrapping_add(1);
        }
    }

    /// Telemetry records that found no room.
    pub fn dropped(&self) -> u32 {
        self.dropped
    }

    /// The next byte for the line.
    pub fn pop(&mut self) -> Option<u8> {
        self.bytes.pop_front()
    }

    /// Whether nothing waits.
    pub fn is_empty(&self) -> bool {
        self.bytes.is_empty()
    }

    /// The bytes of whole frames, or none of them.
    fn push(&mut self, frame: &[u8], left_free: usize) -> bool {
        if self.bytes.len() + frame.len() + left_free > BYTES {
            return false;
        }
        frame.iter().all(|&byte| self.bytes.push_back(byte).is_ok())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn telemetry_that_finds_no_room_is_counted_and_answers_find_some() {
        let mut outbox = Outbox::<400>::new();
        for _ in 0..5 {
            outbox.push_telemetry(&[1; 60]);
        }
        assert_eq!(outbox.dropped(), 3);
        assert!(outbox.push_answer(&[2; MAX_FRAME_BYTES]));
        let sent: Vec<u8> = core::iter::from_fn(|| outbox.pop()).collect();
        assert_eq!(sent.len(), 120 + MAX_FRAME_BYTES);
        assert!(outbox.is_empty());
    }
}
