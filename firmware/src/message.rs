//! What the host says to the board in a frame, and the byte that it gets back.

/// A request of the host; each gets one [`Status`] back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Message<'a> {
    /// How are you?
    Query,
    /// Begin the reference.
    Start,
    /// Put out 0 V.
    Stop,
    /// Take this encoded parameter block; only while not running.
    Block(&'a [u8]),
}

impl<'a> Message<'a> {
    /// The message in a frame: one byte is a command, more are a block.
    pub fn from_frame(frame: &'a [u8]) -> Option<Self> {
        match frame {
            [1] => Some(Self::Query),
            [2] => Some(Self::Start),
            [3] => Some(Self::Stop),
            [] | [_] => None,
            block => Some(Self::Block(block)),
        }
    }
}

/// How the board is, in one byte.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Status {
    /// Bit 0: the request was carried out.
    pub accepted: bool,
    /// Bit 1: there is a parameter block.
    pub loaded: bool,
    /// Bit 2: the controller runs; otherwise the outputs are at 0 V.
    pub running: bool,
    /// Bit 3: a tick was not done when the next one was due.
    pub overrun: bool,
    /// Bit 4: the converter does not answer as it should; the board does not start.
    pub converter_fault: bool,
}

impl Status {
    /// The status as a byte.
    pub fn to_byte(self) -> u8 {
        let flags = [self.accepted, self.loaded, self.running, self.overrun, self.converter_fault];
        flags.iter().enumerate().fold(0, |byte, (bit, flag)| byte | u8::from(*flag) << bit)
    }

    /// The status in a byte.
    pub fn from_byte(byte: u8) -> Self {
        let flag = |bit: u8| byte >> bit & 1 == 1;
        Self {
            accepted: flag(0),
            loaded: flag(1),
            running: flag(2),
            overrun: flag(3),
            converter_fault: flag(4),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_byte_is_a_command_more_are_a_block() {
        assert_eq!(Message::from_frame(&[1]), Some(Message::Query));
        assert_eq!(Message::from_frame(&[2]), Some(Message::Start));
        assert_eq!(Message::from_frame(&[3]), Some(Message::Stop));
        assert_eq!(Message::from_frame(&[4]), None);
        assert_eq!(Message::from_frame(&[]), None);
        assert_eq!(Message::from_frame(&[2, 2]), Some(Message::Block(&[2, 2])));
    }

    #[test]
    fn a_status_survives_the_line() {
        for byte in 0..32 {
            assert_eq!(Status::from_byte(byte).to_byte(), byte);
        }
    }
}
