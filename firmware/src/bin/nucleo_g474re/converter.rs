//! The AD5754R, three voltages of +-10 V.
//!
//! While CLR is low the outputs are at 0 V whatever else happens. A resistor
//! pulls it low while nothing drives it: in reset, without power, without firmware.

use cortex_m::asm;
use embassy_stm32::Peri;
use embassy_stm32::gpio::{Level, Output, Speed};
use embassy_stm32::mode::Blocking;
use embassy_stm32::peripherals::{PB10, PB11, PB12, PB13, PB14, PB15, SPI2};
use embassy_stm32::spi::mode::Master;
use embassy_stm32::spi::{Config, Error, MODE_1, Spi};
use embassy_stm32::time::Hertz;
use firmware::DacCode;
use firmware::ad5754r::{self, Channel, Frame};

/// Answers are valid 40 ns after the edge, so they are fetched slowly.
const READ_CLOCK: Hertz = Hertz(5_312_500);
/// 170 MHz / 8; the converter takes up to 30 MHz.
const WRITE_CLOCK: Hertz = Hertz(21_250_000);

// Times of the data sheet in cycles of 170 MHz, 5.9 ns each; a delay lasts at least as long.
const CYCLES_PER_US: u32 = 170;
/// SYNC stays high for 100 ns after a frame is written.
const SYNC_HIGH_CYCLES: u32 = 17;
/// And for 200 ns where an answer is fetched.
const SYNC_HIGH_READING_CYCLES: u32 = 34;
/// From SYNC high to LDAC low, 130 ns.
const SYNC_TO_LOAD_CYCLES: u32 = 23;
/// LDAC stays low for 20 ns.
const LOAD_CYCLES: u32 = 4;
/// CLR takes 2.5 us to act.
const CLEAR_US: u32 = 5;

/// Registers that are read back: a range for each joint, and the power.
const REGISTERS: usize = Channel::JOINTS.len() + 1;

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

impl From<Error> for ConverterFault {
    fn from(_: Error) -> Self {
        Self::Line
    }
}

/// The pins of the converter, as the data sheet names them from the converter's side.
pub struct ConverterPins {
    pub spi: Peri<'static, SPI2>,
    pub clock: Peri<'static, PB13>,
    pub data_out: Peri<'static, PB15>,
    pub data_in: Peri<'static, PB14>,
    pub sync: Peri<'static, PB12>,
    pub load: Peri<'static, PB11>,
    pub clear: Peri<'static, PB10>,
}

/// The converter; channels A, B and C are the motors of joints 1, 2 and 3.
pub struct Converter {
    spi: Spi<'static, Blocking, Master>,
    sync: Output<'static>,
    load: Output<'static>,
    clear: Output<'static>,
    /// Which register is read next.
    next_read: usize,
}

impl Converter {
    /// Takes the pins; the outputs stay at 0 V.
    pub fn new(pins: ConverterPins) -> Self {
        let clear = Output::new(pins.clear, Level::Low, Speed::Medium);
        Self {
            spi: Spi::new_blocking(
                pins.spi,
                pins.clock,
                pins.data_out,
                pins.data_in,
                at(READ_CLOCK),
            ),
            sync: Output::new(pins.sync, Level::High, Speed::High),
            load: Output::new(pins.load, Level::High, Speed::High),
            clear,
            next_read: 0,
        }
    }

    /// Selects +-10 V, switches the channels on and reads back that it is so.
    pub fn set_up(&mut self) -> Result<(), ConverterFault> {
        self.hold_at_zero();
        self.set_clock(READ_CLOCK)?;
        self.send(ad5754r::select_range())?;
        self.send(ad5754r::select_settings())?;
        self.send(ad5754r::power_up())?;
        asm::delay(ad5754r::POWER_UP_US * CYCLES_PER_US);
        asm::delay(CLEAR_US * CYCLES_PER_US);
        self.check()?;
        self.set_clock(WRITE_CLOCK)
    }

    /// All outputs to 0 V, and no code changes that until [`Self::release`].
    #[inline]
    pub fn hold_at_zero(&mut self) {
        self.clear.set_low();
    }

    /// Lets the outputs follow the codes; they stay at 0 V until the next one.
    #[inline]
    pub fn release(&mut self) {
        self.clear.set_high();
    }

    /// Three codes, which the outputs follow at the same instant; takes 6 us.
    #[inline]
    pub fn put_out(&mut self, codes: &[DacCode; 3]) -> Result<(), ConverterFault> {
        for (channel, code) in Channel::JOINTS.into_iter().zip(codes) {
            self.send(ad5754r::set_code(channel, *code))?;
        }
        asm::delay(SYNC_TO_LOAD_CYCLES);
        self.load.set_low();
        asm::delay(LOAD_CYCLES);
        self.load.set_high();
        Ok(())
    }

    /// Reads one register back, another one each time, and what is wrong a second time; takes
    /// 20 us, the codes stay.
    pub fn watch(&mut self) -> Result<(), ConverterFault> {
        let which = self.next_read;
        self.next_read = (which + 1) % REGISTERS;
        self.set_clock(READ_CLOCK)?;
        let read = self.read_back(which).or_else(|_| self.read_back(which));
        self.set_clock(WRITE_CLOCK)?;
        read
    }

    fn check(&mut self) -> Result<(), ConverterFault> {
        (0..REGISTERS).try_for_each(|which| self.read_back(which))
    }

    /// Compares a register with what was written: the range of a channel, or the power.
    fn read_back(&mut self, which: usize) -> Result<(), ConverterFault> {
        let (is_right, fault) = match Channel::JOINTS.get(which) {
            Some(channel) => {
                let answer = self.ask(ad5754r::ask_range(*channel))?;
                (ad5754r::range_is_right(answer), ConverterFault::Range)
            }
            None => {
                let answer = self.ask(ad5754r::ask_power())?;
                (ad5754r::power_is_right(answer), ConverterFault::Power)
            }
        };
        if is_right { Ok(()) } else { Err(fault) }
    }

    fn set_clock(&mut self, clock: Hertz) -> Result<(), ConverterFault> {
        // The only error there is would be a frequency above the clock's.
        self.spi.set_config(&at(clock)).map_err(|()| ConverterFault::Line)
    }

    #[inline]
    fn send(&mut self, frame: Frame) -> Result<(), ConverterFault> {
        self.sync.set_low();
        let result = self.spi.blocking_write(&frame);
        self.sync.set_high();
        asm::delay(SYNC_HIGH_CYCLES);
        Ok(result?)
    }

    /// The answer to a question comes with the frame after it.
    fn ask(&mut self, question: Frame) -> Result<Frame, ConverterFault> {
        self.send(question)?;
        asm::delay(SYNC_HIGH_READING_CYCLES);
        let mut answer = ad5754r::NO_OPERATION;
        self.sync.set_low();
        let result = self.spi.blocking_transfer_in_place(&mut answer);
        self.sync.set_high();
        asm::delay(SYNC_HIGH_READING_CYCLES);
        result?;
        Ok(answer)
    }
}

/// The converter takes data over on the falling edge.
fn at(clock: Hertz) -> Config {
    let mut config = Config::default();
    config.mode = MODE_1;
    config.frequency = clock;
    config
}
