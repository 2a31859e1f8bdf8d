//! The board's own condition, at a tick and at its boot.

use super::fault::FaultRecord;

/// The board's own condition at a tick.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Health {
    /// The tick before this one was not done when this one was due.
    pub overrun: bool,
    /// The converter does not answer as it should.
    pub converter_fault: bool,
    /// The parameters in use are not those that were checked.
    pub parameters_corrupt: bool,
    /// The clock that ticks is not true: see [`clocks_agree`](crate::clock_check::clocks_agree).
    pub clock_wrong: bool,
    /// The emergency stop is pressed, or its wire is broken.
    pub emergency_stop: bool,
    /// The amplifiers have no power, or the wire that says so is broken.
    pub drive_power_lost: bool,
    /// The host was heard since the last tick.
    pub host_heard: bool,
    /// From the last tick's beginning to its codes [0.1 us].
    pub tick_time_tenth_us: u16,
}

impl Health {
    /// Whether the board itself is unfit to drive.
    pub(super) fn is_unfit(&self) -> bool {
        self.converter_fault | self.parameters_corrupt | self.clock_wrong
    }

    /// Whether anything is wrong with the board.
    #[inline]
    pub(super) fn is_ill(&self) -> bool {
        self.overrun
            | self.converter_fault
            | self.parameters_corrupt
            | self.clock_wrong
            | self.emergency_stop
            | self.drive_power_lost
    }
}

/// What was found while the board booted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BootReport {
    /// The fault that was latched before the reset.
    pub latched: Option<FaultRecord>,
    /// The watchdog caused the reset.
    pub watchdog_reset: bool,
    /// The board was armed before the reset.
    pub was_armed: bool,
    /// The supply was gone or too low; at every power-on, too.
    pub supply_failed: bool,
    /// Parameters are stored, but none of them is valid.
    pub parameters_corrupt: bool,
    /// The converter does not answer as it should.
    pub converter_fault: bool,
    /// The encoders count from zero, wherever the arm is: it cannot be armed before
    /// [`Order::Home`](super::Order::Home) has set its position.
    pub position_lost: bool,
}
