//! Frames on SPI2 to the AD5754R and back, each between two edges of SYNC.

use cortex_m::asm;
use embassy_stm32::pac;
use embassy_stm32::pac::SPI2;
use embassy_stm32::pac::spi::regs::Sr;
use embassy_stm32::pac::spi::vals::Br;
use firmware::ad5754r::{self, Frame};

/// Answers are valid 40 ns after the edge, so they are fetched slowly: at 5.3 MHz.
pub const READ_CLOCK: Br = Br::DIV32;
/// 21.25 MHz; the converter takes up to 30 MHz.
pub const WRITE_CLOCK: Br = Br::DIV8;
/// SYNC stays high for 100 ns after a frame is written.
const SYNC_HIGH_CYCLES: u32 = 17;
/// And for 200 ns where an answer is fetched.
const SYNC_HIGH_READING_CYCLES: u32 = 34;
/// SYNC of the converter is PB12.
const SYNC_PIN: usize = 12;
/// Looks at a frame that is under way before the block is given up: 24 bits are 192 cycles, a look
/// takes at least four.
const POLLS: u32 = 60;
/// What a frame takes that is sent slowly.
const SLOW_FRAME_CYCLES: u32 = 768;

/// Bits of the status: busy, and bytes that wait to be sent.
const SENDING: u32 = 1 << 7 | 3 << 11;
/// Bits of the status: bytes were lost, another master.
const ERRORS: u32 = 1 << 6 | 1 << 5;

/// Why the converter is not to be trusted.
#[derive(Clone, Copy, defmt::Format)]
pub enum ConverterFault {
    /// The SPI itself reports an error.
    Line,
    /// The range read back is not the one written: no converter, no power, a broken wire.
    Range,
    /// A channel is off, overloaded or too hot.
    Power,
}

/// The answer to a question comes with the frame after it.
pub fn ask(question: Frame) -> Result<Frame, ConverterFault> {
    send(question)?;
    asm::delay(SYNC_HIGH_READING_CYCLES);
    begin(ad5754r::NO_OPERATION);
    let answer = slow_end()?;
    asm::delay(SYNC_HIGH_READING_CYCLES);
    Ok(answer)
}

#[inline]
pub fn send(frame: Frame) -> Result<(), ConverterFault> {
    begin(frame);
    slow_end()?;
    asm::delay(SYNC_HIGH_CYCLES);
    Ok(())
}

/// While nothing is being sent.
pub fn set_clock(divider: Br) {
    SPI2.cr1().modify(|w| w.set_spe(false));
    SPI2.cr1().modify(|w| w.set_br(divider));
    SPI2.cr1().modify(|w| w.set_spe(true));
}

/// Pulls SYNC low and puts a frame into the queue, which has room for four bytes.
#[inline]
pub fn begin(frame: Frame) {
    pac::GPIOB.bsrr().write(|w| w.set_br(SYNC_PIN, true));
    SPI2.dr16().write_value(u16::from_le_bytes([frame[0], frame[1]]));
    SPI2.dr8().write_value(frame[2]);
}

/// Waits for the frame's last bit, lets SYNC rise, and fetches what came in meanwhile.
#[inline]
pub fn end() -> Result<Frame, ConverterFault> {
    let status = status_when_sent();
    pac::GPIOB.bsrr().write(|w| w.set_bs(SYNC_PIN, true));
    let [first, second] = SPI2.dr16().read().to_le_bytes();
    let third = SPI2.dr8().read();
    match status.0 & (SENDING | ERRORS) != 0 {
        true => Err(ConverterFault::Line),
        false => Ok([first, second, third]),
    }
}

/// The same for a frame that is sent slowly.
fn slow_end() -> Result<Frame, ConverterFault> {
    asm::delay(SLOW_FRAME_CYCLES);
    end()
}

/// The block's status once a frame is through, or after so many looks.
#[inline(never)]
fn status_when_sent() -> Sr {
    let mut left = POLLS;
    loop {
        let status = SPI2.sr().read();
        left -= 1;
        if status.0 & SENDING == 0 || left == 0 {
            return status;
        }
    }
}
