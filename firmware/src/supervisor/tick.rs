//! A tick of the supervisor: the controller's codes, and zero instead where there is a fault.

use super::fault::{Fault, State};
use super::health::Health;
use super::joint_monitor::LimitViolation;
use super::state_machine::Supervisor;
use super::stop_category::StopCategory;
use super::tick_record::TickRecord;
use crate::joint::JointSample;
use crate::{Angle, DacCode, Mode};

impl Supervisor {
    /// One tick: counts since power-on in; codes, and all that there is to tell, out.
    pub fn tick(&mut self, counts: &[i32; 3], health: Health) -> TickRecord {
        self.act(counts, &health);
        self.complete()
    }

    /// The first part of a tick: counts since power-on in, [`Self::codes`] out. [`Self::complete`] follows
    /// before the next order or tick.
    #[inline(never)]
    pub fn act(&mut self, counts: &[i32; 3], health: &Health) {
        self.health = *health;
        self.counters.ticks = self.counters.ticks.wrapping_add(1);
        // Without a branch, so that the tick's cost does not depend on the line.
        self.silent_ticks = self.silent_ticks.saturating_add(1) * u32::from(!health.host_heard);
        if self.state == State::Stopping && self.controlled_stop.is_over() {
            self.stop(State::Faulted);
        }
        let counts = self.home.model_counts(counts);
        let board = self.board_fault();
        let joint = self.control(&counts);
        if let Some(violation) = board {
            self.enter_fault(0, violation);
        } else if let Some((index, fault)) = joint {
            self.enter_joint_fault(index, fault);
        }
    }

    /// The codes of the last tick for the converter; `None` where it is held at 0 V.
    #[inline]
    pub fn codes(&self) -> Option<[DacCode; 3]> {
        self.driven().map(|last| last.each_ref().map(|sample| sample.code))
    }

    /// The second part of a tick, once the codes are out: what no code depends on.
    #[inline(never)]
    pub fn complete(&mut self) -> TickRecord {
        let Health { overrun, tick_time_tenth_us, .. } = self.health;
        self.counters.overruns = self.counters.overruns.wrapping_add(u32::from(overrun));
        let longest = self.counters.longest_tick_tenth_us.max(u32::from(tick_time_tenth_us));
        self.counters.longest_tick_tenth_us = longest;
        self.home.note_travel();
        let counts = self.home.counts();
        if let Some(monitored) = &mut self.monitored {
            monitored.complete();
            for (count, joint) in self.counters.saturated.iter_mut().zip(&monitored.joints) {
                *count = count.wrapping_add(u32::from(joint.was_cut()));
            }
        }
        self.record(&counts)
    }

    /// Computes what the next tick can know already: after [`Self::complete`] and any orders, with
    /// the time that is left. The codes are the same without it.
    #[inline(never)]
    pub fn prepare(&mut self) {
        if let Some(monitored) = &mut self.monitored {
            monitored.controller.prepare();
        }
    }

    /// What the controller has put out, where it goes to the converter.
    #[inline]
    fn driven(&self) -> Option<&[JointSample; 3]> {
        let monitored = self.monitored.as_ref().filter(|_| self.state.drives())?;
        Some(&monitored.last)
    }

    /// A fault of the board, not of a joint.
    #[inline]
    fn board_fault(&self) -> Option<LimitViolation> {
        let is_ill = self.health.is_ill();
        let is_silent = self.host_timeout_ticks.is_some_and(|most| self.silent_ticks > most);
        let holds = self.monitored.as_ref().is_some_and(|m| m.controller.has_ended());
        if is_ill | is_silent | holds { self.first_board_fault() } else { None }
    }

    #[cold]
    fn first_board_fault(&self) -> Option<LimitViolation> {
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
        if self.health.clock_wrong && self.state != State::Boot {
            return Some(LimitViolation::of(Fault::Clock));
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
        let running = self.state.drives();
        let monitored = self.monitored.as_mut()?;
        if monitored.act(counts, running) { self.first_fault(running) } else { None }
    }

    /// Looks at every joint closely.
    #[cold]
    fn first_fault(&mut self, running: bool) -> Option<(usize, Fault)> {
        let monitored = self.monitored.as_mut()?;
        let brakes = self.state == State::Stopping;
        let mut first: Option<(usize, Fault)> = None;
        for index in 0..3 {
            let fault = monitored.fault(index, running, brakes);
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
    fn enter_joint_fault(&mut self, index: usize, fault: Fault) {
        if fault == Fault::EncoderStuck {
            self.home.invalidate(index);
        }
        let Some(monitored) = &self.monitored else { return };
        let violation = match fault {
            Fault::Stalled => {
                let (value, limit) = monitored.unbalanced_v(index);
                LimitViolation { fault, value, limit }
            }
            Fault::MotorTooHot => {
                let (value, limit) = monitored.heat[index].volts();
                LimitViolation { fault, value, limit }
            }
            _ => monitored.joints[index].violation(fault, &monitored.last[index]),
        };
        self.enter_fault(index as u8 + 1, violation);
    }

    /// The record of this tick.
    #[inline]
    fn record(&self, counts: &[i32; 3]) -> TickRecord {
        let running = self.driven();
        TickRecord {
            tick: self.counters.ticks,
            counts: *counts,
            codes: running.map_or([DacCode(0); 3], |last| last.map(|sample| sample.code)),
            reference: running.map_or([Angle(0); 3], |last| last.map(|sample| sample.reference)),
            mode: self.monitored.as_ref().map_or([Mode::OpenLoop; 3], |monitored| monitored.mode),
            state: self.state,
            saturated: running.map_or(0, |last| bits(&last.map(|sample| sample.saturated))),
            fault: self.fault.map(|record| (record.fault, record.joint)),
            tick_time_tenth_us: self.health.tick_time_tenth_us,
        }
    }
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
