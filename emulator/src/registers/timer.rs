//! TIM1 to 6: time bases with compare channels, one with an output, and counters of encoders.

use super::timer_events::Events;
use super::{Access, Level, Time};
use crate::failure::Refusal;

const ENABLE: u32 = 1;
const UPDATE_DISABLE: u32 = 1 << 1;
const UPDATE_BY_COUNTER_ONLY: u32 = 1 << 2;
/// Down, centred, one pulse: not modelled.
const NOT_MODELLED: u32 = 0x78;
/// What other blocks are told: nothing but updates is modelled.
const MASTER_MODE: u32 = 7 << 4;
const UPDATES_TOLD: u32 = 2 << 4;
/// Both edges of both inputs count.
const ENCODER_MODE: u32 = 3;
/// Channels 1 and 2 are inputs from their own pins.
const OWN_INPUTS: u32 = 0x0303;
/// The digital filter of 8 samples at a quarter of the clock, on both.
const FILTERS: u32 = 0x7070;
/// Channel 1 is an output, high below the compare value, which is taken over at once.
const PWM_MODE_1: u32 = 6 << 4;

/// A timer.
#[derive(Clone, Debug)]
pub struct Timer {
    /// Largest value of the counter.
    mask: u32,
    control: u32,
    control2: u32,
    slave: u32,
    enabled: u32,
    flags: u32,
    modes: [u32; 2],
    outputs: u32,
    prescaler: u32,
    prescaler_in_use: u32,
    reload: u32,
    compare: [u32; 4],
    /// The counter at `since`.
    count: u32,
    since: Time,
    /// Updates of the counter since the reset.
    pub updates: u64,
    /// Channel 1 drives a pin.
    has_output: bool,
    level: Level,
    edges: Vec<(Time, Level)>,
}

impl Timer {
    /// A timer after a reset, of 16 or 32 bits.
    pub fn new(bits: u32) -> Self {
        let mask = u32::MAX >> (32 - bits);
        Self {
            mask,
            control: 0,
            control2: 0,
            slave: 0,
            enabled: 0,
            flags: 0,
            modes: [0; 2],
            outputs: 0,
            prescaler: 0,
            prescaler_in_use: 0,
            reload: mask,
            compare: [0; 4],
            count: 0,
            since: 0,
            updates: 0,
            has_output: false,
            level: false,
            edges: Vec::new(),
        }
    }

    /// One whose channel 1 drives a pin.
    pub fn with_output(bits: u32) -> Self {
        Self { has_output: true, ..Self::new(bits) }
    }

    /// The level of its output.
    pub fn output(&self) -> Level {
        self.level
    }

    /// Changes of its output since they were last taken.
    pub fn take_edges(&mut self) -> Vec<(Time, Level)> {
        std::mem::take(&mut self.edges)
    }

    /// The output follows the counter, high below the compare value.
    fn drives(&self) -> bool {
        self.has_output && self.outputs & 3 == 1 && self.modes[0] & 0xFF == PWM_MODE_1
    }

    fn set_output(&mut self, at: Time) {
        let level = self.drives() && self.count < self.compare[0];
        if level != std::mem::replace(&mut self.level, level) {
            self.edges.push((at, level));
        }
    }

    /// The output on the way through so many counts.
    fn pass_edges(&mut self, events: &Events, counts: u64) {
        let mut values = [(0, true), (u64::from(self.compare[0]), false)].map(|(value, level)| {
            (events.until(value).filter(|c| *c <= counts * events.cycles), level)
        });
        values.sort();
        for (cycles, level) in values {
            if let Some(cycles) = cycles
                && level != std::mem::replace(&mut self.level, level)
            {
                self.edges.push((self.since + cycles, level));
            }
        }
    }

    /// Whether its interrupt is up.
    pub fn level(&self) -> Level {
        self.flags & self.enabled & 0x5F != 0
    }

    /// Whether it counts time.
    pub fn is_running(&self) -> bool {
        self.control & ENABLE != 0 && self.slave & 7 == 0
    }

    /// Whether its updates are told to other blocks.
    pub fn tells_updates(&self) -> bool {
        self.control2 & MASTER_MODE == UPDATES_TOLD
    }

    /// Whether it counts the edges of an encoder.
    pub fn counts_encoder(&self) -> bool {
        self.control & ENABLE != 0 && self.slave & 0x0001_0007 == ENCODER_MODE
    }

    /// Moves the encoder on; an edge that comes while it does not count is lost.
    ///
    /// # Errors
    /// Its inputs or filters are not set up as the wiring needs it.
    pub fn move_encoder(&mut self, counts: i32) -> Access<()> {
        if !self.counts_encoder() || counts == 0 {
            return Ok(());
        }
        if self.modes[0] & (OWN_INPUTS | 0xF0F0) != 0x0101 | FILTERS {
            return Err(Refusal::Value(self.modes[0]));
        }
        self.count = self.count.wrapping_add_signed(counts) & self.mask;
        Ok(())
    }

    fn events(&self) -> Events {
        Events {
            period: u64::from(self.reload) + 1,
            cycles: u64::from(self.prescaler_in_use) + 1,
            from: u64::from(self.count),
        }
    }

    /// When it next raises a flag whose interrupt is enabled.
    pub fn next_event(&self) -> Option<Time> {
        if !self.is_running() {
            return None;
        }
        let events = self.events();
        let update = (self.enabled & 1 != 0 && self.flags & 1 == 0).then_some(0);
        let of_channel = |i: usize| {
            let bit = 1 << (i + 1);
            let waits = self.enabled & bit != 0 && self.flags & bit == 0;
            waits.then_some(u64::from(self.compare[i]))
        };
        let edges =
            if self.drives() { [Some(0), Some(u64::from(self.compare[0]))] } else { [None; 2] };
        let values = update.into_iter().chain((0..4).filter_map(of_channel));
        let values = values.chain(edges.into_iter().flatten());
        values.filter_map(|value| events.until(value)).min().map(|cycles| self.since + cycles)
    }

    /// When the counter last began anew, as long as it counts time.
    pub fn period_began(&self) -> Time {
        self.since - u64::from(self.count) * (u64::from(self.prescaler_in_use) + 1)
    }

    /// Takes it to a point of time.
    pub fn advance(&mut self, now: Time) {
        if !self.is_running() {
            self.since = now;
            return;
        }
        let events = self.events();
        let counts = (now - self.since) / events.cycles;
        if counts == 0 {
            return;
        }
        if self.drives() {
            self.pass_edges(&events, counts);
        }
        let updates = events.times(0, counts);
        self.updates += updates;
        if updates > 0 && self.control & UPDATE_DISABLE == 0 {
            self.flags |= 1;
            self.prescaler_in_use = self.prescaler;
        }
        for (i, value) in self.compare.into_iter().enumerate() {
            if events.times(u64::from(value), counts) > 0 {
                self.flags |= 2 << i;
            }
        }
        self.count = ((events.from + counts) % events.period) as u32;
        self.since += counts * events.cycles;
    }

    /// A register; the timer must have been taken to the present.
    ///
    /// # Errors
    /// None of those modelled.
    pub fn read(&self, offset: u32) -> Access<u32> {
        match offset {
            0x00 => Ok(self.control),
            0x04 => Ok(self.control2),
            0x08 => Ok(self.slave),
            0x0C => Ok(self.enabled),
            0x10 => Ok(self.flags),
            0x18 | 0x1C => Ok(self.modes[(offset as usize - 0x18) / 4]),
            0x20 => Ok(self.outputs),
            0x24 => Ok(self.count),
            0x28 => Ok(self.prescaler),
            0x2C => Ok(self.reload),
            0x34..0x44 => Ok(self.compare[(offset as usize - 0x34) / 4]),
            _ => Err(Refusal::NotModelled),
        }
    }

    /// The same, written.
    ///
    /// # Errors
    /// None of those modelled, or a mode that is not.
    pub fn write(&mut self, offset: u32, value: u32, now: Time) -> Access<()> {
        match offset {
            0x00 if value & NOT_MODELLED != 0 => return Err(Refusal::Value(value)),
            0x00 => {
                if value & !self.control & ENABLE != 0 {
                    self.since = now;
                }
                self.control = value;
            }
            0x04 => self.control2 = value,
            0x08 if matches!(value & 0x0001_0007, 0 | ENCODER_MODE) => self.slave = value,
            0x0C => self.enabled = value,
            // Zeros clear.
            0x10 => self.flags &= value,
            0x14 if value == 1 => self.update(now),
            0x18 | 0x1C => self.modes[(offset as usize - 0x18) / 4] = value,
            0x20 => self.outputs = value,
            0x24 => (self.count, self.since) = (value & self.mask, now),
            0x28 => self.prescaler = value & 0xFFFF,
            0x2C => self.reload = value & self.mask,
            0x34..0x44 => self.compare[(offset as usize - 0x34) / 4] = value & self.mask,
            _ => return Err(Refusal::Value(value)),
        }
        self.set_output(now);
        Ok(())
    }

    /// An update by software: the counter begins anew with the new prescaler.
    fn update(&mut self, now: Time) {
        (self.count, self.since) = (0, now);
        self.prescaler_in_use = self.prescaler;
        if self.control & (UPDATE_BY_COUNTER_ONLY | UPDATE_DISABLE) == 0 {
            self.flags |= 1;
        }
    }
}
