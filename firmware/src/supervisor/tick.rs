//! A tick of the supervisor: the controller's codes, and zero instead where there is a fault.

use super::fault::{Fault, State};
use super::health::Health;
use super::joint_monitor::{JointSample, LimitViolation};
use super::monitored_controller::MonitoredController;
use super::state_machine::Supervisor;
use super::stop_category::StopCategory;
use super::tick_record::TickRecord;
use crate::{Angle, DacCode, Mode};

impl Supervisor {
    /// One tick: counts since power-on in; codes, and all that there is to tell, out.
    #[inline(never)]
    pub fn tick(&mut self, counts: &[i32; 3], health: Health) -> TickRecord {
        self.health = health;
        self.counters.ticks = self.counters.ticks.wrapping_add(1);
        self.counters.overruns = self.counters.overruns.wrapping_add(u32::from(health.overrun));
        let longest = self.counters.longest_tick_tenth_us.max(u32::from(health.tick_time_tenth_us));
        self.counters.longest_tick_tenth_us = longest;
        // Without a branch, so that the tick's cost does not depend on the line.
        self.silent_ticks = self.silent_ticks.saturating_add(1) * u32::from(!health.host_heard);
        if self.state == State::Stopping && self.controlled_stop.is_over() {
            self.stop(State::Faulted);
        }
        let counts = &self.home.model_counts(counts);
        let board = self.board_fault();
        let joint = self.control(counts);
        if let Some(violation) = board {
            self.enter_fault(0, violation);
        } else if let Some((index, fault)) = joint {
            self.enter_joint_fault(index, fault, counts[index]);
        }
        self.record(counts)
    }

    /// A fault of the board, not of a joint.
    #[inline]
    fn board_fault(&self) -> Option<LimitViolation> {
        if self.state.enables() && self.health.emergency_stop {
            return Some(LimitViolation::of(Fault::EmergencyStop));
        }
        if self.state.enables() && self.health.drive_power_lost {
            return Some(LimitViolation::of(Fault::DrivePower));
        }
        if self.health.converter_fault && self.state != State::Boot {
            return Some(LimitViolation::of(Fault::Converter));
        }
        if self.health.parameters_corrupt && self.state != State::Boot {
            return Some(LimitViolation::of(Fault::CorruptParameters));
        }
        if self.health.overrun && self.state.enables() {
            return Some(LimitViolation::of(Fault::TickOverrun));
        }
        if let Some(violation) = self.held_too_long() {
            return Some(violation);
        }
        let most = self.host_timeout_ticks?;
        (self.silent_ticks > most).then(|| self.link_lost(most))
    }

    /// Whether the joints have been held for too long.
    #[inline]
    fn held_too_long(&self) -> Option<LimitViolation> {
        let controller =
            &self.monitored.as_ref().filter(|_| self.state == State::Running)?.controller;
        let (value, limit) = (controller.held_s(), controller.block().safety.hold_s);
        (value > limit).then_some(LimitViolation { fault: Fault::HoldTooLong, value, limit })
    }

    fn link_lost(&self, most_ticks: u32) -> LimitViolation {
        let period_s =
            self.monitored.as_ref().map_or(0.0, |w| w.controller.block().sample_period_s);
        let seconds = |ticks: u32| ticks as f32 * period_s;
        LimitViolation {
            fault: Fault::LinkLost,
            value: seconds(self.silent_ticks),
            limit: seconds(most_ticks),
        }
    }

    /// Runs the controller and checks every joint; returns the first one (0 to 2) at fault.
    #[inline]
    fn control(&mut self, counts: &[i32; 3]) -> Option<(usize, Fault)> {
        let monitored = self.monitored.as_mut()?;
        monitored.last = monitored.controller.tick(counts);
        let running = self.state.drives();
        let brakes = self.state == State::Stopping;
        let mut first: Option<(usize, Fault)> = None;
        for index in 0..3 {
            let sample = monitored.sample(index, counts[index]);
            let joint = &mut monitored.joints[index];
            let fault =
                if running { joint.check_running(&sample) } else { joint.check_at_rest(&sample) };
            let is_due = running && fault.is_none() && joint.stall().is_due();
            let fault = match is_due && monitored.is_stalled(index) {
                true => Some(Fault::Stalled),
                false => fault,
            };
            let leaves =
                running && !brakes && fault.is_none() && joint_leaves(monitored, index, &sample);
            let fault = if leaves { Some(Fault::PositionLimit) } else { fault };
            let cut = u32::from(sample.saturated);
            self.counters.saturated[index] = self.counters.saturated[index].wrapping_add(cut);
            if fault == Some(Fault::EncoderJump) {
                self.home.invalidate(index);
            }
            // A fault that takes the voltage away goes before one that is braked.
            if let Some(fault) = fault
                && first.is_none_or(|(_, other)| is_graver(fault, other))
            {
                first = Some((index, fault));
            }
        }
        // An arm at 0 V that people move about is no fault; it is only not armed.
        first.filter(|_| self.state.enables())
    }

    #[cold]
    fn enter_joint_fault(&mut self, index: usize, fault: Fault, count: i32) {
        if fault == Fault::EncoderStuck {
            self.home.invalidate(index);
        }
        let Some(monitored) = &self.monitored else { return };
        let violation = match fault {
            Fault::Stalled => {
                let (value, limit) = monitored.unbalanced_v(index);
                LimitViolation { fault, value, limit }
            }
            _ => monitored.joints[index].violation(fault, &monitored.sample(index, count)),
        };
        self.enter_fault(index as u8 + 1, violation);
    }

    /// The record of this tick.
    #[inline]
    fn record(&self, counts: &[i32; 3]) -> TickRecord {
        let output = self.monitored.as_ref().map(|monitored| (&monitored.last, monitored.mode));
        let running = output.filter(|_| self.state.drives());
        TickRecord {
            tick: self.counters.ticks,
            counts: *counts,
            codes: running.map_or([DacCode(0); 3], |(output, _)| output.codes),
            reference: running.map_or([Angle(0); 3], |(output, _)| output.reference),
            mode: output.map_or([Mode::OpenLoop; 3], |(_, mode)| mode),
            state: self.state,
            saturated: running.map_or(0, |(output, _)| bits(&output.saturated)),
            fault: self.fault.map(|record| (record.fault, record.joint)),
            tick_time_tenth_us: self.health.tick_time_tenth_us,
        }
    }
}

/// Whether joint `index` (0 to 2) would leave its range.
#[inline]
fn joint_leaves(monitored: &MonitoredController, index: usize, sample: &JointSample) -> bool {
    let range = monitored.joints[index].range();
    range.leaves(sample.count, sample.velocity_rad_per_s).is_some()
}

#[inline]
fn is_graver(fault: Fault, other: Fault) -> bool {
    (fault.stop_category(), other.stop_category()) == (StopCategory::Off, StopCategory::Controlled)
}

/// Bit i for the i-th flag.
#[inline]
fn bits(flags: &[bool; 3]) -> u8 {
    u8::from(flags[0]) | u8::from(flags[1]) << 1 | u8::from(flags[2]) << 2
}
