//! The AD5754R: registers behind frames of 24 bits, outputs behind LDAC and CLR.
//!
//! Times are those of its data sheet at 2.7 to 5.5 V; BIN/2sCOMP is at ground.

use crate::failure::Failure;
use crate::registers::spi::Wire;
use crate::registers::{Time, US};

/// Codes of the four channels.
pub type Codes = [i16; 4];

/// Cycles of 170 MHz, rounded up: SYNC high, SYNC to LDAC, LDAC low, CLR to the outputs.
const SYNC_HIGH: Time = 17;
const SYNC_TO_LOAD: Time = 23;
const LOAD_LOW: Time = 4;
/// Shortest bit: 30 MHz to write, 40 ns of delay to read.
const BIT: Time = 6;
const BIT_READING: Time = 14;
/// From power-up of a channel to its output.
const POWER_UP: Time = 10 * US;

const RANGE_10_V_BIPOLAR: u16 = 4;
const CHANNELS_ON: u16 = 0xF;
const REFERENCE_ON: u16 = 1 << 4;

/// The converter.
#[derive(Clone, Debug, Default)]
pub struct Converter {
    sync: Edge,
    load: Edge,
    /// CLR is not low.
    released: bool,
    frame: Vec<u8>,
    slowest_bit: Time,
    fastest_bit: Time,
    input: Codes,
    /// Codes of the outputs.
    pub codes: Codes,
    range: [u16; 4],
    power: u16,
    powered_at: Time,
    settings: u16,
    answer: Option<u32>,
    /// The analog supply is gone: nothing is put out, channels switch themselves off.
    pub supply_lost: bool,
    /// Outputs that are damaged and stay at a voltage, whatever they are told [V].
    pub sticks_at_v: [Option<f64>; 3],
    /// The first thing done against the data sheet.
    pub failure: Option<Failure>,
    /// Pulses of LDAC since power-on.
    pub loads: u64,
    /// When LDAC last fell.
    pub loaded_at: Time,
}

/// A pin, and when it changed.
#[derive(Clone, Copy, Debug, Default)]
struct Edge {
    high: bool,
    at: Time,
}

impl Converter {
    /// After its supply came back; what is broken stays so.
    pub fn after_power_on(&self) -> Self {
        let (supply_lost, sticks_at_v) = (self.supply_lost, self.sticks_at_v);
        Self { supply_lost, sticks_at_v, ..Self::default() }
    }

    /// Voltages at outputs A, B and C [V].
    pub fn volts(&self) -> [f64; 3] {
        [0, 1, 2].map(|i| match self.sticks_at_v[i] {
            Some(volts) => volts,
            None if self.is_driving(i) => f64::from(self.codes[i]) * 10.0 / 32768.0,
            None => 0.0,
        })
    }

    /// Whether CLR lets the outputs follow.
    pub fn is_released(&self) -> bool {
        self.released
    }

    fn is_driving(&self, channel: usize) -> bool {
        self.power >> channel & 1 == 1
            && self.power & REFERENCE_ON != 0
            && self.range[channel] == RANGE_10_V_BIPOLAR
            && self.released
            && !self.supply_lost
    }

    /// What the pins SYNC, LDAC and CLR have now; a resistor pulls SYNC and LDAC up, CLR down.
    /// Whether SYNC has changed.
    pub fn set_pins(&mut self, sync: bool, load: bool, clear: bool, now: Time) -> bool {
        let is_edge = sync != self.sync.high;
        if is_edge {
            self.set_sync(sync, now);
        }
        if load != self.load.high {
            self.set_load(load, now);
        }
        if !clear {
            self.codes = [0; 4];
        }
        self.released = clear;
        is_edge
    }

    /// LDAC alone.
    pub fn change_load(&mut self, high: bool, at: Time) {
        if high != self.load.high {
            self.set_load(high, at);
        }
    }

    fn set_sync(&mut self, high: bool, now: Time) {
        let lasted = now - self.sync.at;
        let is_first = self.sync.at == 0;
        self.sync = Edge { high, at: now };
        match high {
            false if lasted < SYNC_HIGH && !is_first => {
                self.refuse(format!("SYNC was high for {lasted} cycles only"))
            }
            false => {
                self.frame.clear();
                (self.fastest_bit, self.slowest_bit) = (Time::MAX, 0);
            }
            // Fewer than 24 bits do nothing.
            true if self.frame.len() < 3 => {}
            true => self.take_frame(now),
        }
    }

    fn set_load(&mut self, high: bool, now: Time) {
        let lasted = now - self.load.at;
        let since_sync = now - self.sync.at;
        let is_first = self.load.at == 0;
        self.load = Edge { high, at: now };
        if high {
            if lasted < LOAD_LOW && !is_first {
                self.refuse(format!("LDAC was low for {lasted} cycles only"));
            }
            return;
        }
        if since_sync < SYNC_TO_LOAD || !self.sync.high {
            self.refuse(format!("LDAC fell {since_sync} cycles after SYNC"));
        }
        if now < self.powered_at + POWER_UP {
            self.refuse("LDAC fell before the channels were up".to_owned());
        }
        self.loads += 1;
        self.loaded_at = now;
        if self.released {
            self.codes = self.input;
        }
    }

    fn refuse(&mut self, why: String) {
        self.failure.get_or_insert(Failure::Converter(why));
    }

    fn take_frame(&mut self, now: Time) {
        let frame = &self.frame[self.frame.len() - 3..];
        let (head, data) = (frame[0], u16::from_be_bytes([frame[1], frame[2]]));
        let (reads, register, channel) = (head & 0x80 != 0, head >> 3 & 7, usize::from(head & 7));
        if head & 0x40 != 0 {
            return self.refuse(format!("bit 22 of the frame {head:02x}{data:04x} is not 0"));
        }
        if self.fastest_bit < BIT {
            return self.refuse(format!("a bit of {} cycles", self.fastest_bit));
        }
        if reads {
            self.answer = Some(self.value(register, channel));
        } else {
            self.write(register, channel, data, now);
        }
    }

    fn value(&self, register: u8, channel: usize) -> u32 {
        let value = match register {
            0 => self.input[channel.min(3)] as u16,
            1 => self.range[channel.min(3)],
            2 if self.supply_lost => self.power & !CHANNELS_ON,
            2 => self.power,
            _ => self.settings,
        };
        u32::from(register) << 19 | (channel as u32) << 16 | u32::from(value)
    }

    fn write(&mut self, register: u8, channel: usize, data: u16, now: Time) {
        match (register, channel) {
            (0, 0..4) => self.input[channel] = data as i16,
            (0, 4) => self.input = [data as i16; 4],
            (1, 0..4) => self.range[channel] = data & 7,
            (1, 4) => self.range = [data & 7; 4],
            (2, 0) => {
                self.power = data & (CHANNELS_ON | REFERENCE_ON);
                self.powered_at = now;
            }
            (3, 0) => {}
            (3, 1) => self.settings = data & 0xF,
            (3, 4) => self.input = [0; 4],
            _ => self.refuse(format!("the frame to register {register}, channel {channel}")),
        }
    }
}

impl Wire for Converter {
    /// Bits are taken over on the falling edge; while SYNC is high they are not for this chip.
    fn exchange(&mut self, byte: u8, falling_edge: bool, bit: Time) -> u8 {
        if self.sync.high {
            return 0xFF;
        }
        if !falling_edge {
            self.refuse("the clock has the wrong phase".to_owned());
        }
        self.fastest_bit = self.fastest_bit.min(bit);
        if self.frame.is_empty() && self.answer.is_some() && bit < BIT_READING {
            self.refuse(format!("an answer is fetched with bits of {bit} cycles"));
        }
        let answer = self.answer.unwrap_or(0).to_be_bytes();
        let out = answer.get(1 + self.frame.len()).copied().unwrap_or(0);
        self.frame.push(byte);
        if self.frame.len() == 3 {
            self.answer = None;
        }
        out
    }
}
