//! From the converter's outputs back to the inputs of ADC1: the dividers of `docs/board.md`.

use crate::board::Board;
use crate::failure::Failure;

/// Inputs of ADC1 at PC0, PC1 and PC2.
const INPUTS: [usize; 3] = [6, 7, 8];
/// From the output, to 3.3 V, to ground [kOhm].
const RESISTORS: [f64; 3] = [33.0, 10.0, 15.0];
/// What the ADC measures with [V], and its counts.
const SUPPLY_V: f64 = 3.3;
const COUNTS: f64 = 4096.0;

/// What a divider brings to its input [V].
fn divided_v(output_v: f64) -> f64 {
    let [output, supply, ground] = RESISTORS.map(|ohms| 1.0 / ohms);
    (output_v * output + SUPPLY_V * supply) / (output + supply + ground)
}

impl Board {
    /// Has each event of TIM6 start ADC1, where the image asks for it.
    pub(crate) fn pass_timer_to_adc(&mut self) {
        let updates = self.tim6.updates;
        if std::mem::replace(&mut self.adc_updates, updates) == updates {
            return;
        }
        if !self.adc.waits_for_timer() || !self.tim6.tells_updates() {
            return;
        }
        let volts = self.converter.volts();
        let counts: Vec<u16> =
            self.adc.inputs().into_iter().map(|i| self.counts(i, &volts)).collect();
        if let Err(refusal) = self.adc.start(self.tim6.period_began(), &counts) {
            let why = format!("ADC1 at an event of TIM6: {refusal}");
            self.failure.get_or_insert(Failure::Core(why));
        }
    }

    /// What an input comes to; one that nothing is at, or whose pin is not analog, to nothing.
    fn counts(&self, input: usize, volts: &[f64; 3]) -> u16 {
        let Some(output) = INPUTS.iter().position(|wired| *wired == input) else { return 0 };
        match self.gpio[2].is_analog(output) {
            true => (divided_v(volts[output]) / SUPPLY_V * COUNTS).clamp(0.0, COUNTS - 1.0) as u16,
            false => 0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_dividers_are_those_that_the_firmware_reckons_with() {
        for output_v in [-10.0, 0.0, 2.5, 10.0] {
            let counts = (divided_v(output_v) / SUPPLY_V * COUNTS) as u16;
            let read_v = f64::from(firmware::loopback::volts(counts));
            assert!((read_v - output_v).abs() < 0.01, "{output_v} V: {read_v} V");
        }
    }
}
