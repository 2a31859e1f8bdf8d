//! All that the processor sees of the chip, and all that stands around the chip.

use crate::converter::Converter;
use crate::core::cost::Cost;
use crate::core::nvic::{NMI, Nvic};
use crate::core::system_control::SystemControl;
use crate::failure::{Failure, Refusal};
use crate::handler;
use crate::plant::Plant;
use crate::registers::adc::Adc;
use crate::registers::dma::Dma;
use crate::registers::flash::Flash;
use crate::registers::gpio::{Gpio, Pin};
use crate::registers::low_power_timer::LowPowerTimer;
use crate::registers::lpuart::Lpuart;
use crate::registers::power::Power;
use crate::registers::random::Random;
use crate::registers::rcc::{Rcc, Reset};
use crate::registers::spi::Spi;
use crate::registers::timer::Timer;
use crate::registers::watchdog::Watchdog;
use crate::registers::{Access, CLOCK_HZ, MS, Time};
use crate::trace::Trace;

/// Ports A to G.
const PORTS: usize = 7;
/// Pins of the converter at port B: LDAC, CLR, SYNC, and those of SPI2.
const LOAD: usize = 6;
/// The function that gives LDAC to TIM4.
const LOAD_FUNCTION: u32 = 2;
const CLEAR: usize = 10;
const SYNC: usize = 12;
const SPI_PINS: [usize; 3] = [13, 14, 15];

/// The chip's blocks, the converter, the arm, and the time.
pub struct Board {
    /// The time.
    pub now: Time,
    /// When the engine stops at the latest.
    pub stop_at: Time,
    /// How long instructions take.
    pub cost: Cost,
    /// Instructions executed since the first power-on.
    pub instructions: u64,
    /// The interrupt controller.
    pub nvic: Nvic,
    /// The core's own registers.
    pub system: SystemControl,
    /// Clocks and resets.
    pub rcc: Rcc,
    /// The core's voltage.
    pub power: Power,
    /// The flash.
    pub flash: Flash,
    /// Pins.
    pub gpio: [Gpio; PORTS],
    /// Encoders of joints 1, 2, 3: TIM2, TIM3, TIM1.
    pub encoders: [Timer; 3],
    /// LDAC.
    pub tim4: Timer,
    /// The clock of the executor.
    pub tim5: Timer,
    /// The tick.
    pub tim6: Timer,
    /// Counts the watchdog's clock.
    pub lptim1: LowPowerTimer,
    /// Measures the converter's outputs.
    pub adc: Adc,
    /// Updates of TIM6 that it has seen.
    pub(crate) adc_updates: u64,
    /// The line to the converter.
    pub spi: Spi,
    /// The converter.
    pub converter: Converter,
    /// The line to the host.
    pub lpuart: Lpuart,
    /// Moves bytes for it.
    pub dma: Dma,
    /// The watchdog.
    pub watchdog: Watchdog,
    /// What a debugger is to keep running.
    pub debug: u32,
    /// Random words.
    pub random: Random,
    /// The arm.
    pub plant: Box<dyn Plant>,
    /// What was seen, tick by tick.
    pub trace: Trace,
    /// The first thing that the model does not have.
    pub failure: Option<Failure>,
    /// What the arm's encoders have counted.
    pub counts: [i32; 3],
    /// Updates of TIM6 that the arm has seen.
    pub ticks: u64,
    /// When the arm moves where nothing ticks.
    pub plant_at: Time,
}

impl Board {
    /// A board at its first power-on.
    pub fn new(flash: Vec<u8>, plant: Box<dyn Plant>) -> Self {
        let counts = plant.counts();
        let mut board = Self {
            now: 0,
            stop_at: 0,
            cost: Cost::default(),
            instructions: 0,
            nvic: Nvic::default(),
            system: SystemControl::default(),
            rcc: Rcc::after(Reset::PowerOn, 0),
            power: Power::default(),
            flash: Flash::new(flash),
            gpio: [0, 1, 2, 3, 4, 5, 6].map(Gpio::new),
            encoders: [Timer::new(32), Timer::new(16), Timer::new(16)],
            tim4: Timer::with_output(16),
            tim5: Timer::new(32),
            tim6: Timer::new(16),
            lptim1: LowPowerTimer::default(),
            adc: Adc::default(),
            adc_updates: 0,
            spi: Spi::default(),
            converter: Converter::default(),
            lpuart: Lpuart::new(),
            dma: Dma::default(),
            watchdog: Watchdog::default(),
            debug: 0,
            random: Random::new(1),
            plant,
            trace: Trace::default(),
            failure: None,
            counts,
            ticks: 0,
            plant_at: MS,
        };
        board.clocks_changed();
        board.pins_changed();
        board
    }

    /// Begins anew; flash, converter, arm and, but for a power-on, the flags of resets stay.
    pub fn reset(&mut self, reset: Reset) {
        let (flags, crystal) = (self.rcc.flags(), self.rcc.crystal);
        let loses_supply = matches!(reset, Reset::PowerOn | Reset::BrownOut);
        let flags = if loses_supply { 0 } else { flags };
        self.rcc = Rcc::after(reset, flags);
        self.rcc.crystal = crystal;
        let flash = std::mem::replace(&mut self.flash, Flash::new(Vec::new()));
        self.flash = flash.after_reset();
        self.nvic = Nvic::default();
        self.system = SystemControl::default();
        self.power = Power::default();
        self.gpio = [0, 1, 2, 3, 4, 5, 6].map(Gpio::new);
        self.encoders = [Timer::new(32), Timer::new(16), Timer::new(16)];
        self.tim4 = Timer::with_output(16);
        (self.tim5, self.tim6) = (Timer::new(32), Timer::new(16));
        (self.adc, self.adc_updates) = (Adc::default(), 0);
        self.lptim1 = LowPowerTimer::default();
        self.spi = Spi::default();
        self.lpuart = Lpuart::new();
        self.dma = Dma::default();
        let clock_hz = self.watchdog.clock_hz;
        self.watchdog = Watchdog::default();
        self.watchdog.clock_hz = clock_hz;
        self.ticks = 0;
        self.plant_at = self.now + MS;
        if loses_supply {
            self.converter = self.converter.after_power_on();
        }
        self.plant.board_was_reset();
        self.clocks_changed();
        self.pins_changed();
    }

    /// The crystal fails.
    pub fn fail_crystal(&mut self) {
        if self.rcc.fail_crystal() {
            self.nvic.pend(NMI);
        }
        self.clocks_changed();
    }

    /// What instructions cost from here on.
    pub fn clocks_changed(&mut self) {
        self.cost.cycle = (CLOCK_HZ / self.rcc.core_hz().max(1)).max(1);
        (self.cost.wait_states, self.cost.cached) = self.flash.timing();
    }

    /// Tells the converter what its pins have.
    pub fn pins_changed(&mut self) {
        self.spi.advance(self.now, &mut self.converter);
        let level = |number, floating| match self.gpio[1].pin(number) {
            Pin::Output(high) => high,
            Pin::Alternate(LOAD_FUNCTION) if number == LOAD => self.tim4.output(),
            _ => floating,
        };
        let (sync, load, clear) = (level(SYNC, true), level(LOAD, true), level(CLEAR, false));
        if self.converter.set_pins(sync, load, clear, self.now) {
            let now = self.cost_so_far();
            self.trace.handler.sync(now);
        }
        self.trace.released(self.now, self.converter.is_released());
    }

    /// Brings changes of TIM4's output to LDAC, at their times.
    pub(crate) fn pass_load(&mut self) {
        for (at, level) in self.tim4.take_edges() {
            if self.gpio[1].pin(LOAD) == Pin::Alternate(LOAD_FUNCTION) {
                self.converter.change_load(level, at);
            }
        }
    }

    /// Instructions and cycles since the first power-on.
    pub(crate) fn cost_so_far(&self) -> handler::Cost {
        handler::Cost { instructions: self.instructions, cycles: self.now }
    }

    /// Whether pins of a port are given to a block.
    pub fn given(&self, port: usize, pins: &[usize], function: u32) -> Access<()> {
        let given = |pin: &usize| self.gpio[port].pin(*pin) == Pin::Alternate(function);
        if pins.iter().all(given) { Ok(()) } else { Err(Refusal::Pins) }
    }

    /// The same for SPI2.
    ///
    /// # Errors
    /// They are not.
    pub fn spi_pins(&self) -> Access<()> {
        self.given(1, &SPI_PINS, 5)
    }
}
