//! All that the processor sees of the chip, and all that stands around the chip.

use crate::converter::Converter;
use crate::core::cost::Cost;
use crate::core::nvic::{NMI, Nvic};
use crate::core::system_control::SystemControl;
use crate::failure::{Failure, Refusal};
use crate::plant::Plant;
use crate::registers::dma::Dma;
use crate::registers::flash::Flash;
use crate::registers::gpio::{Gpio, Pin};
use crate::registers::lpuart::{Lpuart, RECEIVE_REQUEST, SEND_REQUEST};
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
/// Pins of the converter at port B: CLR, LDAC, SYNC, and those of SPI2.
const CLEAR: usize = 10;
const LOAD: usize = 11;
const SYNC: usize = 12;
const SPI_PINS: [usize; 3] = [13, 14, 15];

/// Lines of the interrupt controller.
pub const DMA1_CHANNEL1: usize = 11;
/// As above.
pub const TIM5: usize = 50;
/// As above.
pub const TIM6: usize = 54;
/// As above.
pub const RNG: usize = 90;
/// As above.
pub const LPUART1: usize = 91;

/// Memory that the DMA reads and writes.
pub trait Memory {
    /// A byte of the RAM.
    fn read(&mut self, address: u32) -> Option<u8>;
    /// Puts a byte there; false outside the RAM.
    fn write(&mut self, address: u32, byte: u8) -> bool;
}

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
    /// The clock of the executor.
    pub tim5: Timer,
    /// The tick.
    pub tim6: Timer,
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
    counts: [i32; 3],
    ticks: u64,
    plant_at: Time,
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
            tim5: Timer::new(32),
            tim6: Timer::new(16),
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
        let flags = if reset == Reset::PowerOn { 0 } else { flags };
        self.rcc = Rcc::after(reset, flags);
        self.rcc.crystal = crystal;
        let flash = std::mem::replace(&mut self.flash, Flash::new(Vec::new()));
        self.flash = flash.after_reset();
        self.nvic = Nvic::default();
        self.system = SystemControl::default();
        self.power = Power::default();
        self.gpio = [0, 1, 2, 3, 4, 5, 6].map(Gpio::new);
        self.encoders = [Timer::new(32), Timer::new(16), Timer::new(16)];
        (self.tim5, self.tim6) = (Timer::new(32), Timer::new(16));
        self.spi = Spi::default();
        self.lpuart = Lpuart::new();
        self.dma = Dma::default();
        let clock_hz = self.watchdog.clock_hz;
        self.watchdog = Watchdog::default();
        self.watchdog.clock_hz = clock_hz;
        self.ticks = 0;
        self.plant_at = self.now + MS;
        if reset == Reset::PowerOn {
            let supply_lost = self.converter.supply_lost;
            self.converter = Converter::default();
            self.converter.supply_lost = supply_lost;
        }
        self.plant.board_was_reset();
        self.clocks_changed();
        self.pins_changed();
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
            _ => floating,
        };
        let (sync, load, clear) = (level(SYNC, true), level(LOAD, true), level(CLEAR, false));
        self.converter.set_pins(sync, load, clear, self.now);
        self.trace.released(self.now, self.converter.is_released());
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

    /// The next time at which something comes of itself.
    pub fn next_event(&self) -> Time {
        let events = [
            self.tim5.next_event(),
            self.tim6.next_event(),
            self.lpuart.next_event(),
            self.flash.next_event(),
            self.watchdog.bites_at(),
            Some(self.plant_at),
        ];
        events.into_iter().flatten().min().unwrap_or(Time::MAX)
    }

    /// Takes all blocks to the present, but for the arm and the bytes that the DMA moves.
    pub fn catch_up(&mut self) {
        self.tim5.advance(self.now);
        self.tim6.advance(self.now);
        self.spi.advance(self.now, &mut self.converter);
        self.lpuart.advance(self.now);
        self.flash.advance(self.now);
    }

    /// Takes everything to the present; a reset that the watchdog makes is returned.
    pub fn advance(&mut self, memory: &mut impl Memory) -> Option<Reset> {
        self.catch_up();
        self.move_arm();
        self.move_bytes(memory);
        self.set_lines();
        self.failure = self.failure.take().or_else(|| self.converter.failure.take());
        let bitten = self.watchdog.bites_at().is_some_and(|at| at <= self.now);
        if std::mem::take(&mut self.system.reset) {
            return Some(Reset::Software);
        }
        bitten.then_some(Reset::Watchdog)
    }

    /// A step of the arm with each tick, or each millisecond while nothing ticks.
    fn move_arm(&mut self) {
        let is_due = match self.tim6.is_running() {
            true => self.tim6.updates != self.ticks,
            false => self.now >= self.plant_at,
        };
        if self.now >= self.plant_at {
            self.plant_at = self.now + MS;
        }
        if !is_due {
            return;
        }
        self.ticks = self.tim6.updates;
        let volts = self.converter.volts();
        self.plant.advance(&volts);
        let counts = self.plant.counts();
        let moved = [0, 1, 2].map(|i| counts[i].wrapping_sub(self.counts[i]));
        self.counts = counts;
        self.trace.tick(self.now, &self.converter, self.ticks);
        let pins = [(&[0, 1], 1), (&[6, 7], 2), (&[8, 9], 6)];
        for (i, (pins, function)) in pins.into_iter().enumerate() {
            let given = match self.encoders[i].counts_encoder() {
                true => self.given(0, pins, function),
                false => Ok(()),
            };
            if let Err(refusal) = given.and_then(|()| self.encoders[i].move_encoder(moved[i])) {
                let why = format!("the counter of encoder {}: {refusal}", i + 1);
                self.failure.get_or_insert(Failure::Core(why));
            }
        }
        self.trace.counts = [0, 1, 2].map(|i| self.encoders[i].read(0x24).unwrap_or(0));
    }

    fn move_bytes(&mut self, memory: &mut impl Memory) {
        while self.lpuart.has_for_dma() {
            let Some(address) = self.dma.serves(RECEIVE_REQUEST, false) else { break };
            let Some(byte) = self.lpuart.take_by_dma() else { break };
            if !memory.write(address, byte) {
                self.bad_dma(address);
            }
            self.dma.moved(RECEIVE_REQUEST, false);
        }
        while self.lpuart.asks_dma() {
            let Some(address) = self.dma.serves(SEND_REQUEST, true) else { break };
            match memory.read(address) {
                Some(byte) => self.lpuart.send(byte, self.now),
                None => return self.bad_dma(address),
            }
            self.dma.moved(SEND_REQUEST, true);
        }
    }

    fn bad_dma(&mut self, address: u32) {
        self.failure.get_or_insert(Failure::Core(format!("the DMA at {address:#010x}")));
    }

    /// Tells the interrupt controller which lines are up.
    pub fn set_lines(&mut self) {
        let lines = [
            (DMA1_CHANNEL1, self.dma.level(0)),
            (DMA1_CHANNEL1 + 1, self.dma.level(1)),
            (TIM5, self.tim5.level()),
            (TIM6, self.tim6.level()),
            (LPUART1, self.lpuart.level()),
            (RNG, self.random.level()),
        ];
        for (line, level) in lines {
            self.nvic.set_level(line, level);
        }
        if self.flash.raises_nmi() && self.nvic.running() != NMI {
            self.nvic.pend(NMI);
        }
    }
}
