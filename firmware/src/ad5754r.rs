//! Frames of the AD5754R, a quad 16-bit converter with bipolar outputs.
//!
//! Twenty-four bits, the most significant first, data taken over on the falling
//! edge of the clock:
//!
//! ```text
//! R/W  0  register (3)  channel (3)  data (16)
//! ```
//!
//! The pin BIN/2sCOMP is tied to ground, so data is in two's complement, as
//! [`DacCode`] is. A frame fills the input register of a channel; the pulse on
//! LDAC makes the outputs of all channels follow at once.

use crate::DacCode;

/// One frame as it goes over the line.
pub type Frame = [u8; 3];

/// Answers are fetched with this, which does nothing else.
pub const NO_OPERATION: Frame = write(Register::Control, 0, 0);

/// An output of the converter; joint i is at the i-th.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// Output A, joint 1.
    A = 0,
    /// Output B, joint 2.
    B = 1,
    /// Output C, joint 3.
    C = 2,
}

impl Channel {
    /// The channels of joints 1, 2 and 3.
    pub const JOINTS: [Self; 3] = [Self::A, Self::B, Self::C];
}

#[derive(Clone, Copy)]
enum Register {
    Dac = 0,
    OutputRange = 1,
    PowerControl = 2,
    Control = 3,
}

const ALL_CHANNELS: u8 = 4;
const CONTROL_SETTINGS: u8 = 1;

/// Output range -10 V to 10 V.
const RANGE_10_V_BIPOLAR: u16 = 4;
/// Channels A, B, C and the internal 2.5 V reference on; D stays off.
const POWER_UP: u16 = 0b1_0111;
/// Thermal shutdown on; 20 mA clamp on, so that a short circuit does not switch
/// the channel off for good; CLR means 0 V; SDO on.
const SETTINGS: u16 = 0b1100;

/// Wait after [`power_up`] before the first LDAC [us].
pub const POWER_UP_US: u32 = 10;

/// Puts a code into the input register of a channel.
#[inline]
pub const fn set_code(channel: Channel, code: DacCode) -> Frame {
    write(Register::Dac, channel as u8, code.0 as u16)
}

/// Selects the range of +-10 V on all channels; before [`power_up`].
pub const fn select_range() -> Frame {
    write(Register::OutputRange, ALL_CHANNELS, RANGE_10_V_BIPOLAR)
}

/// Sets what the converter does on CLR, on overload and when too hot.
pub const fn select_settings() -> Frame {
    write(Register::Control, CONTROL_SETTINGS, SETTINGS)
}

/// Switches the three channels and the reference on.
pub const fn power_up() -> Frame {
    write(Register::PowerControl, 0, POWER_UP)
}

/// Asks for the range of a channel; the next frame fetches the answer.
pub const fn ask_range(channel: Channel) -> Frame {
    read(Register::OutputRange, channel as u8)
}

/// Asks what is switched on; the next frame fetches the answer.
pub const fn ask_power() -> Frame {
    read(Register::PowerControl, 0)
}

/// Whether the answer to [`ask_range`] is the range selected.
pub const fn range_is_right(answer: Frame) -> bool {
    data(answer) & 0b111 == RANGE_10_V_BIPOLAR
}

/// Whether the answer to [`ask_power`] is all on and nothing overloaded or too hot.
pub const fn power_is_right(answer: Frame) -> bool {
    data(answer) & 0b111_1011_1111 == POWER_UP
}

#[inline]
const fn write(register: Register, address: u8, data: u16) -> Frame {
    let [high, low] = data.to_be_bytes();
    [(register as u8) << 3 | address, high, low]
}

const fn read(register: Register, address: u8) -> Frame {
    [0x80 | (register as u8) << 3 | address, 0, 0]
}

const fn data(frame: Frame) -> u16 {
    u16::from_be_bytes([frame[1], frame[2]])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_those_of_the_data_sheet() {
        assert_eq!(set_code(Channel::A, DacCode(0)), [0x00, 0x00, 0x00]);
        assert_eq!(set_code(Channel::B, DacCode(i16::MAX)), [0x01, 0x7F, 0xFF]);
        assert_eq!(set_code(Channel::C, DacCode(-1)), [0x02, 0xFF, 0xFF]);
        assert_eq!(select_range(), [0x0C, 0x00, 0x04]);
        assert_eq!(power_up(), [0x10, 0x00, 0x17]);
        assert_eq!(select_settings(), [0x19, 0x00, 0x0C]);
        assert_eq!(NO_OPERATION, [0x18, 0x00, 0x00]);
        assert_eq!(ask_range(Channel::C), [0x8A, 0x00, 0x00]);
        assert_eq!(ask_power(), [0x90, 0x00, 0x00]);
    }

    #[test]
    fn an_absent_converter_is_noticed() {
        for silence in [[0x00; 3], [0xFF; 3]] {
            assert!(!range_is_right(silence));
            assert!(!power_is_right(silence));
        }
    }

    #[test]
    fn an_overload_is_noticed() {
        assert!(power_is_right([0x90, 0x00, 0x17]));
        assert!(!power_is_right([0x90, 0x00, 0x13]), "channel C is off");
        assert!(!power_is_right([0x90, 0x00, 0x37]), "too hot");
        assert!(!power_is_right([0x90, 0x00, 0x97]), "channel A is overloaded");
        assert!(!power_is_right([0x90, 0x02, 0x17]), "channel C is overloaded");
    }
}
