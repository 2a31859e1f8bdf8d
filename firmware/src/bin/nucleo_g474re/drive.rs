//! Amplifiers, brakes and the emergency stop: two levels out, two in.
//!
//! Every level that is missing, or whose wire is broken, is the safe one: resistors pull the
//! outputs low while nothing drives them, the inputs pull themselves low.

use embassy_stm32::gpio::{Input, Level, Output, Pull, Speed};
use embassy_stm32::pac::gpio::vals::Idr;
use embassy_stm32::peripherals::{PC5, PC6, PC8, PC9};
use embassy_stm32::{Peri, pac};
use firmware::supervisor::{DriveOutputs, Health};

/// The inputs are PC5 and PC8.
const EMERGENCY_STOP: usize = 5;
const POWER_GOOD: usize = 8;

/// The pins to amplifiers and emergency stop.
pub struct DrivePins {
    pub enable: Peri<'static, PC6>,
    pub brakes: Peri<'static, PC9>,
    pub power_good: Peri<'static, PC8>,
    pub emergency_stop: Peri<'static, PC5>,
}

/// The levels to and from the amplifiers.
pub struct Drive {
    enable: Output<'static>,
    brakes: Output<'static>,
    _power_good: Input<'static>,
    _not_pressed: Input<'static>,
    /// What was low in the tick before: a single disturbed sample stops nothing.
    was_low: [bool; 2],
}

impl Drive {
    /// Takes the pins; amplifiers disabled, brakes engaged.
    pub fn new(pins: DrivePins) -> Self {
        Self {
            enable: Output::new(pins.enable, Level::Low, Speed::Low),
            brakes: Output::new(pins.brakes, Level::Low, Speed::Low),
            _power_good: Input::new(pins.power_good, Pull::Down),
            _not_pressed: Input::new(pins.emergency_stop, Pull::Down),
            was_low: [true; 2],
        }
    }

    /// Reads both inputs, for the tick.
    #[inline]
    pub fn read(&mut self, health: &mut Health) {
        // Both at once, at the same instant.
        let levels = pac::GPIOC.idr().read();
        let is_low = [EMERGENCY_STOP, POWER_GOOD].map(|pin| levels.idr(pin) == Idr::LOW);
        health.emergency_stop = is_low[0] && self.was_low[0];
        health.drive_power_lost = is_low[1] && self.was_low[1];
        self.was_low = is_low;
    }

    /// Sets both outputs.
    #[inline]
    pub fn write(&mut self, outputs: DriveOutputs) {
        self.enable.set_level(outputs.enable.into());
        self.brakes.set_level(outputs.release_brakes.into());
    }
}
