//! What happens on a board of itself: time passes, the arm moves, bytes come and go.

use crate::board::Board;
use crate::core::nvic::NMI;
use crate::failure::Failure;
use crate::registers::lpuart::{RECEIVE_REQUEST, SEND_REQUEST};
use crate::registers::rcc::Reset;
use crate::registers::{MS, Time};

/// Lines of the interrupt controller.
const DMA1_CHANNEL1: usize = 11;
const TIM5: usize = 50;
/// The line of the tick.
pub const TIM6: usize = 54;
const RNG: usize = 90;
const LPUART1: usize = 91;

/// Pins of the encoders at port A, and the function that gives them to the timers.
const ENCODER_PINS: [([usize; 2], u32); 3] = [([0, 1], 1), ([6, 7], 2), ([8, 9], 6)];

/// Memory that the DMA reads and writes.
pub trait Memory {
    /// A byte of the RAM.
    fn read(&mut self, address: u32) -> Option<u8>;
    /// Puts a byte there; false outside the RAM.
    fn write(&mut self, address: u32, byte: u8) -> bool;
}

impl Board {
    /// The next time at which something comes of itself.
    pub fn next_event(&self) -> Time {
        let events = [
            self.tim4.next_event(),
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
        self.tim4.advance(self.now);
        self.pass_load();
        self.tim5.advance(self.now);
        self.tim6.advance(self.now);
        let low_power_hz = self.rcc.low_power_timer_hz(self.watchdog.clock_hz);
        self.lptim1.advance(self.now, low_power_hz);
        self.pass_timer_to_adc();
        self.adc.advance(self.now);
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
        let began = if self.tim6.is_running() { self.tim6.period_began() } else { self.now };
        self.trace.tick(began, &self.converter, self.ticks);
        for (i, counts) in moved.into_iter().enumerate() {
            self.move_encoder(i, counts);
        }
        self.trace.counts = [0, 1, 2].map(|i| self.encoders[i].read(0x24).unwrap_or(0));
    }

    fn move_encoder(&mut self, index: usize, counts: i32) {
        let (pins, function) = ENCODER_PINS[index];
        let given = match self.encoders[index].counts_encoder() {
            true => self.given(0, &pins, function),
            false => Ok(()),
        };
        if let Err(refusal) = given.and_then(|()| self.encoders[index].move_encoder(counts)) {
            let why = format!("the counter of encoder {}: {refusal}", index + 1);
            self.failure.get_or_insert(Failure::Core(why));
        }
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
