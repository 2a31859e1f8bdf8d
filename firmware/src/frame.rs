//! Frames on a serial line: COBS, ended by a zero byte.
//!
//! A zero never occurs inside a frame, so after a lost or a broken byte the next
//! zero begins the next intact frame.

/// Longest content of a frame [bytes].
pub const MAX_CONTENT_BYTES: usize = 256;
/// Longest frame on the line, without the zero: the content and COBS's own bytes.
const MAX_ENCODED_BYTES: usize = MAX_CONTENT_BYTES + MAX_CONTENT_BYTES / 254 + 1;

/// Collects the bytes of a line into frames.
#[derive(Clone, Debug)]
pub struct FrameReader {
    encoded: [u8; MAX_ENCODED_BYTES],
    length: usize,
    broken: bool,
    dropped: u32,
}

impl FrameReader {
    /// A reader at the beginning of a frame.
    pub const fn new() -> Self {
        Self { encoded: [0; MAX_ENCODED_BYTES], length: 0, broken: false, dropped: 0 }
    }

    /// Takes a byte, returns the content of the frame that it ends.
    pub fn push(&mut self, byte: u8) -> Option<&[u8]> {
        if byte == 0 {
            return self.end();
        }
        match self.encoded.get_mut(self.length) {
            Some(slot) => *slot = byte,
            None => return self.give_up(),
        }
        self.length += 1;
        None
    }

    /// Bytes were lost: what has come of this frame, and what comes until the next zero, is void.
    pub fn discard(&mut self) {
        self.broken = true;
    }

    /// Frames thrown away since the start.
    pub fn dropped(&self) -> u32 {
        self.dropped
    }

    fn give_up(&mut self) -> Option<&[u8]> {
        self.broken = true;
        None
    }

    fn end(&mut self) -> Option<&[u8]> {
        let length = core::mem::take(&mut self.length);
        let broken = core::mem::take(&mut self.broken);
        if length == 0 && !broken {
            return None; // Zeros between frames mean nothing.
        }
        let content = match broken {
            true => None,
            false => cobs::decode_in_place(&mut self.encoded[..length]).ok(),
        };
        if content.is_none() {
            self.dropped = self.dropped.saturating_add(1);
        }
        self.encoded.get(..content?)
    }
}

impl Default for FrameReader {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frames(reader: &mut FrameReader, line: &[u8]) -> Vec<Vec<u8>> {
        line.iter().filter_map(|&byte| reader.push(byte).map(<[u8]>::to_vec)).collect()
    }

    fn encoded(content: &[u8]) -> Vec<u8> {
        let mut line = vec![0; content.len() + content.len() / 254 + 2];
        let length = cobs::encode(content, &mut line);
        line.truncate(length);
        line.push(0);
        line
    }

    #[test]
    fn what_goes_in_comes_out() {
        let mut reader = FrameReader::new();
        let longest: Vec<u8> = (0..MAX_CONTENT_BYTES).map(|k| (k % 256) as u8).collect();
        for content in [&[7][..], &[0, 1, 0], &[1; 255], &longest] {
            assert_eq!(frames(&mut reader, &encoded(content)), [content.to_vec()]);
        }
        assert_eq!(reader.dropped(), 0);
    }

    #[test]
    fn zeros_between_frames_mean_nothing() {
        let mut reader = FrameReader::new();
        assert_eq!(frames(&mut reader, &[0, 0, 2, 9, 0, 0]), [[9]]);
        assert_eq!(reader.dropped(), 0);
    }

    #[test]
    fn after_a_loss_the_next_frame_is_whole() {
        let mut reader = FrameReader::new();
        assert!(frames(&mut reader, &[9, 1, 2]).is_empty());
        reader.discard();
        assert_eq!(frames(&mut reader, &[3, 4, 0, 2, 9, 0]), [[9]]);
        assert_eq!(reader.dropped(), 1);
    }

    #[test]
    fn an_endless_frame_is_dropped() {
        let mut reader = FrameReader::new();
        let mut line = vec![1; 5 * MAX_ENCODED_BYTES];
        line.extend([0, 2, 9, 0]);
        assert_eq!(frames(&mut reader, &line), [[9]]);
        assert_eq!(reader.dropped(), 1);
    }

    #[test]
    fn a_frame_that_is_not_cobs_is_dropped() {
        let mut reader = FrameReader::new();
        assert!(frames(&mut reader, &[9, 1, 0]).is_empty());
        assert_eq!(reader.dropped(), 1);
    }
}
