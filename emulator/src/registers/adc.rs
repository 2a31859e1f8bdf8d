//! ADC1: injected conversions that TIM6 starts, as far as the image uses them.

use super::{Access, CLOCK_HZ, Time, US};
use crate::failure::Refusal;

/// Bits of CR.
const ENABLE: u32 = 1;
const START_INJECTED: u32 = 1 << 3;
const REGULATOR: u32 = 1 << 28;
const DEEP_POWER_DOWN: u32 = 1 << 29;
const CALIBRATE: u32 = 1 << 31;
/// Bits of ISR: ready, a conversion done, all of them done.
const READY: u32 = 1;
const INJECTED_DONE: u32 = 1 << 5;
const SEQUENCE_DONE: u32 = 1 << 6;
/// From the regulator to the calibration, the calibration, from enabling to ready.
const REGULATOR_STARTS: Time = 20 * US;
const CALIBRATION: Time = 3 * US;
const GETS_READY: Time = US;
/// Cycles of a clock of the ADC, a quarter of the buses'.
const CLOCK: Time = 4;
/// `CKMODE` of that, where CCR has it.
const CLOCK_MODE: u32 = 3 << 16;
/// The update of TIM6 starts on its rising edge, in JSQR.
const BY_TIM6: u32 = 14 << 2 | 1 << 7;
/// Halves of a clock that a sample takes, by its field.
const SAMPLE_HALVES: [Time; 8] = [5, 13, 25, 49, 95, 185, 495, 1281];
/// And the conversion after it.
const CONVERSION_HALVES: Time = 25;

/// ADC1 with the registers that it shares with ADC2.
#[derive(Clone, Debug)]
pub struct Adc {
    control: u32,
    clock_mode: u32,
    flags: u32,
    samples: u32,
    sequence: u32,
    results: [u16; 4],
    regulator_since: Time,
    calibrates_until: Time,
    ready_at: Time,
    /// Conversions that are under way, by the times at which they are done.
    under_way: Vec<(Time, usize, u16)>,
}

impl Default for Adc {
    fn default() -> Self {
        Self {
            control: DEEP_POWER_DOWN,
            clock_mode: 0,
            flags: 0,
            samples: 0,
            sequence: 0,
            results: [0; 4],
            regulator_since: 0,
            calibrates_until: 0,
            ready_at: 0,
            under_way: Vec::new(),
        }
    }
}

impl Adc {
    /// Whether TIM6's update starts conversions.
    pub fn waits_for_timer(&self) -> bool {
        self.control & START_INJECTED != 0 && self.sequence & 0x1FC == BY_TIM6
    }

    /// Inputs of the sequence.
    pub fn inputs(&self) -> Vec<usize> {
        let length = self.sequence as usize & 3;
        (0..=length).map(|n| (self.sequence >> (9 + 6 * n) & 0x1F) as usize).collect()
    }

    /// An event of TIM6; `counts` are those that each input of the sequence comes to.
    ///
    /// # Errors
    /// The last sequence is still under way.
    pub fn start(&mut self, at: Time, counts: &[u16]) -> Access<()> {
        self.advance(at);
        if !self.under_way.is_empty() {
            return Err(Refusal::Value(self.sequence));
        }
        let mut done = at;
        for (n, (input, counts)) in self.inputs().into_iter().zip(counts).enumerate() {
            let sample = SAMPLE_HALVES[(self.samples >> (3 * input) & 7) as usize];
            done += (sample + CONVERSION_HALVES) * CLOCK / 2;
            self.under_way.push((done, n, *counts));
        }
        Ok(())
    }

    /// Takes it to the present.
    pub fn advance(&mut self, now: Time) {
        while let Some((at, n, counts)) = self.under_way.first().copied()
            && at <= now
        {
            self.under_way.remove(0);
            self.results[n] = counts;
            self.flags |= INJECTED_DONE;
            if self.under_way.is_empty() {
                self.flags |= SEQUENCE_DONE;
            }
        }
    }

    /// A register; the block must have been taken to the present.
    ///
    /// # Errors
    /// None of those modelled.
    pub fn read(&self, offset: u32, now: Time) -> Access<u32> {
        let is_ready = self.control & ENABLE != 0 && now >= self.ready_at;
        let calibrates = now < self.calibrates_until;
        match offset {
            0x00 => Ok(self.flags | if is_ready { READY } else { 0 }),
            0x08 => Ok(self.control | if calibrates { CALIBRATE } else { 0 }),
            0x14 => Ok(self.samples),
            0x4C => Ok(self.sequence),
            0x80 | 0x84 | 0x88 => Ok(u32::from(self.results[(offset as usize - 0x80) / 4])),
            0x308 => Ok(self.clock_mode),
            _ => Err(Refusal::NotModelled),
        }
    }

    /// The same, written.
    ///
    /// # Errors
    /// None of those modelled, or out of turn.
    pub fn write(&mut self, offset: u32, value: u32, now: Time) -> Access<()> {
        let is_started = self.control & START_INJECTED != 0;
        match offset {
            // Ones clear.
            0x00 => self.flags &= !value,
            0x08 => return self.control(value, now),
            0x14 if value >> 27 == 0 && !is_started => self.samples = value,
            0x4C if !is_started && value & 0x1FC == BY_TIM6 => self.sequence = value,
            0x308 if value == CLOCK_MODE && self.control & ENABLE == 0 => self.clock_mode = value,
            _ => return Err(Refusal::Value(value)),
        }
        Ok(())
    }

    /// Regulator, calibration, enabling, start: in this order, each in its time.
    fn control(&mut self, value: u32, now: Time) -> Access<()> {
        let rises = value & !self.control;
        let (enabled, regulated) = (self.control & ENABLE != 0, self.control & REGULATOR != 0);
        let is_in_turn = match rises {
            0 => true,
            REGULATOR => value & DEEP_POWER_DOWN == 0,
            CALIBRATE => !enabled && regulated && now >= self.regulator_since + REGULATOR_STARTS,
            ENABLE => regulated && now >= self.calibrates_until + 4 * CLOCK,
            START_INJECTED => enabled && now >= self.ready_at && self.clock_mode != 0,
            _ => false,
        };
        if !is_in_turn {
            return Err(Refusal::Value(value));
        }
        match rises {
            REGULATOR => self.regulator_since = now,
            CALIBRATE => self.calibrates_until = now + CALIBRATION,
            ENABLE => self.ready_at = now + GETS_READY,
            _ => {}
        }
        // Zeros leave what runs as it is, but for the regulator and the deep sleep.
        let kept = self.control & (ENABLE | START_INJECTED);
        self.control = value & !CALIBRATE | kept;
        Ok(())
    }
}

/// Clocks of the ADC in a second, at most 60 million.
const _: () = assert!(CLOCK_HZ / CLOCK <= 60_000_000);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_starts_in_turn_and_its_results_come_in_their_time() {
        let mut adc = Adc::default();
        assert!(adc.write(0x08, REGULATOR | CALIBRATE, 0).is_err(), "not both at once");
        adc.write(0x308, CLOCK_MODE, 0).unwrap();
        adc.write(0x08, REGULATOR, 0).unwrap();
        assert!(adc.write(0x08, REGULATOR | CALIBRATE, 10 * US).is_err(), "too early");
        adc.write(0x08, REGULATOR | CALIBRATE, 20 * US).unwrap();
        assert_eq!(adc.read(0x08, 21 * US).unwrap() & CALIBRATE, CALIBRATE);
        assert!(adc.write(0x08, REGULATOR | ENABLE, 21 * US).is_err(), "it calibrates");
        adc.write(0x08, REGULATOR | ENABLE, 30 * US).unwrap();
        adc.write(0x14, 3 << 18 | 3 << 21, 30 * US).unwrap();
        adc.write(0x4C, 1 | BY_TIM6 | 6 << 9 | 7 << 15, 30 * US).unwrap();
        assert!(!adc.waits_for_timer());
        adc.write(0x08, REGULATOR | START_INJECTED, 40 * US).unwrap();
        assert!(adc.waits_for_timer());
        assert_eq!(adc.inputs(), [6, 7]);
        adc.start(50 * US, &[100, 200]).unwrap();
        // 37 clocks each.
        adc.advance(50 * US + 2 * 37 * CLOCK - 1);
        assert_eq!(adc.read(0x00, 60 * US).unwrap() & SEQUENCE_DONE, 0);
        adc.advance(50 * US + 2 * 37 * CLOCK);
        assert_eq!(adc.read(0x00, 60 * US).unwrap() & SEQUENCE_DONE, SEQUENCE_DONE);
        assert_eq!([0x80, 0x84].map(|at| adc.read(at, 60 * US).unwrap()), [100, 200]);
    }
}
