//! The AD5754R, three voltages of +-10 V.
//!
//! While CLR is low the outputs are at 0 V whatever else happens. A resistor
//! pulls it low while nothing drives it: in reset, without power, without firmware.

use cortex_m::asm;
use embassy_stm32::Peri;
use embassy_stm32::gpio::{Level, Output, Speed};
use embassy_stm32::mode::Blocking;
use embassy_stm32::peripherals::{PB10, PB12, PB13, PB14, PB15, SPI2 as Spi2};
use embassy_stm32::spi::mode::Master;
use embassy_stm32::spi::{Config, MODE_1, Spi};
use embassy_stm32::time::Hertz;
use firmware::DacCode;
use firmware::ad5754r::{self, Channel};

use crate::converter_line::{
    ConverterFault, READ_CLOCK, WRITE_CLOCK, ask, begin, end, send, set_clock,
};
use crate::load::Load;

const FIRST_CLOCK: Hertz = Hertz(5_312_500);

// Times of the data sheet in cycles of 170 MHz, 5.9 ns each; a delay lasts at least as long.
const CYCLES_PER_US: u32 = 170;
/// CLR takes 2.5 us to act.
const CLEAR_US: u32 = 5;

/// Registers that are read back: a range for each joint, and the power.
const REGISTERS: usize = Channel::JOINTS.len() + 1;

/// The pins of the converter, as the data sheet names them from the converter's side.
pub struct ConverterPins {
    pub spi: Peri<'static, Spi2>,
    pub clock: Peri<'static, PB13>,
    pub data_out: Peri<'static, PB15>,
    pub data_in: Peri<'static, PB14>,
    pub sync: Peri<'static, PB12>,
    pub clear: Peri<'static, PB10>,
}

/// The converter; channels A, B and C are the motors of joints 1, 2 and 3.
pub struct Converter {
    /// Holds clock and pins; frames are put into the block's registers below.
    _spi: Spi<'static, Blocking, Master>,
    _sync: Output<'static>,
    load: Load,
    clear: Output<'static>,
    /// Which register is read next.
    next_read: usize,
}

impl Converter {
    /// Takes the pins; the outputs stay at 0 V.
    pub fn new(pins: ConverterPins, load: Load) -> Self {
        let clear = Output::new(pins.clear, Level::Low, Speed::Medium);
        let mut config = Config::default();
        // The converter takes data over on the falling edge.
        config.mode = MODE_1;
        config.frequency = FIRST_CLOCK;
        Self {
            _spi: Spi::new_blocking(pins.spi, pins.clock, pins.data_out, pins.data_in, config),
            _sync: Output::new(pins.sync, Level::High, Speed::High),
            load,
            clear,
            next_read: 0,
        }
    }

    /// Selects +-10 V, switches the channels on and reads back that it is so.
    #[cold]
    #[inline(never)]
    pub fn set_up(&mut self) -> Result<(), ConverterFault> {
        self.hold_at_zero();
        set_clock(READ_CLOCK);
        send(ad5754r::select_range())?;
        send(ad5754r::select_settings())?;
        send(ad5754r::power_up())?;
        asm::delay(ad5754r::POWER_UP_US * CYCLES_PER_US);
        asm::delay(CLEAR_US * CYCLES_PER_US);
        (0..REGISTERS).try_for_each(read_back)?;
        set_clock(WRITE_CLOCK);
        Ok(())
    }

    /// Begins to count the time of LDAC, with the tick's timer.
    pub fn start_load(&mut self, clock: Hertz, period: u16) {
        self.load.start(clock, period);
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

    /// A tick begins: LDAC stays high until the codes are there.
    #[inline]
    pub fn begin_tick(&mut self) {
        self.load.hold();
    }

    /// Begins to send a joint's code; the wire takes 1.13 us.
    #[inline]
    pub fn begin(&mut self, channel: Channel, code: DacCode) {
        begin(ad5754r::set_code(channel, code));
    }

    /// Waits until it is through. 100 ns must pass before the next one begins.
    #[inline]
    pub fn end(&mut self) -> Result<(), ConverterFault> {
        end().map(drop)
    }

    /// All codes are through: the timer pulls LDAC low at its time, the outputs follow at once.
    /// Whether that time lay ahead.
    #[inline]
    pub fn load(&mut self) -> bool {
        self.load.release()
    }

    /// Reads one register back, another one each time, and what is wrong a second time; takes
    /// 20 us, the codes stay.
    #[cold]
    #[inline(never)]
    pub fn watch(&mut self) -> Result<(), ConverterFault> {
        self.load.wait();
        let which = self.next_read;
        self.next_read = (which + 1) % REGISTERS;
        set_clock(READ_CLOCK);
        let read = read_back(which).or_else(|_| read_back(which));
        set_clock(WRITE_CLOCK);
        read
    }
}

/// Compares a register with what was written: the range of a channel, or the power.
#[inline(never)]
fn read_back(which: usize) -> Result<(), ConverterFault> {
    let (is_right, fault) = match Channel::JOINTS.get(which) {
        Some(channel) => {
            let answer = ask(ad5754r::ask_range(*channel))?;
            (ad5754r::range_is_right(answer), ConverterFault::Range)
        }
        None => (ad5754r::power_is_right(ask(ad5754r::ask_power())?), ConverterFault::Power),
    };
    if is_right { Ok(()) } else { Err(fault) }
}
