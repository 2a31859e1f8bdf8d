//! Who watches over the controller: states, faults, limits.
//!
//! | from | to | by |
//! | --- | --- | --- |
//! | Boot | Disarmed | [`Supervisor::booted`] without a cause for a fault |
//! | Disarmed | Armed | [`Order::Arm`], if all estimates are plausible |
//! | Armed | Running | [`Order::Run`], if every joint is where its reference begins |
//! | Running | Armed | [`Order::Stop`] |
//! | Armed, Running | Disarmed | [`Order::Disarm`] |
//! | any | Faulted | a fault, see [`Fault`] |
//! | Faulted | Disarmed | [`Order::ClearFault`], and nothing else |
//!
//! The codes are zero in every state but Running, and in the very tick that finds a fault.
//! Orders and new parameters come between ticks, so they take effect at a tick's
//! boundary, all at once.

pub mod fault;
mod health;
mod home;
pub mod latch;
pub mod limits;
mod orders;
mod watch;
mod watched;
mod words;

pub use fault::{Fault, FaultRecord, Implausible, State};
pub use health::{BootReport, Health};
pub use limits::{HardLimits, SafetyLimits};
pub use orders::{Denied, Order};

use crate::link::{Counters, Telemetry};
use crate::{Angle, Controller, DacCode, Mode, ParameterBlock};
use home::Home;
use watch::{Excess, JointWatch, follows};
use watched::Watched;

/// Every so many ticks a board asks [`Supervisor::parameters_are_whole`].
pub const CHECK_EVERY_TICKS: u32 = 1000;

/// The controller under watch.
#[derive(Clone, Debug, Default)]
pub struct Supervisor {
    state: State,
    fault: Option<FaultRecord>,
    watched: Option<Watched>,
    home: Home,
    health: Health,
    host_timeout_ticks: Option<u32>,
    silent_ticks: u32,
    counters: Counters,
}

impl Supervisor {
    /// One tick: counts since power-on in; codes, and all that there is to tell, out.
    #[inline(never)]
    pub fn tick(&mut self, counts: &[i32; 3], health: Health) -> Telemetry {
        self.health = health;
        self.counters.ticks = self.counters.ticks.wrapping_add(1);
        self.counters.overruns = self.counters.overruns.wrapping_add(u32::from(health.overrun));
        let longest = self.counters.longest_tick_tenth_us.max(u32::from(health.tick_time_tenth_us));
        self.counters.longest_tick_tenth_us = longest;
        // Without a branch: what the tick costs shall not depend on the line.
        self.silent_ticks = self.silent_ticks.saturating_add(1) * u32::from(!health.host_heard);
        let counts = &self.home.of_model(counts);
        let board = self.board_fault();
        let joint = self.control(counts);
        if let Some(excess) = board {
            self.enter_fault(0, excess);
        } else if let Some((index, fault)) = joint {
            self.enter_joint_fault(index, fault, counts[index]);
        }
        self.record(counts)
    }

    /// What it is doing.
    pub fn state(&self) -> State {
        self.state
    }

    /// The first cause, while Faulted.
    pub fn fault(&self) -> Option<FaultRecord> {
        self.fault
    }

    /// What it has counted since power-on; what the link counts stays zero.
    pub fn counters(&self) -> &Counters {
        &self.counters
    }

    /// Whether the counts of each joint are those from the model's zero.
    pub fn is_position_known(&self) -> [bool; 3] {
        self.home.is_known()
    }

    /// The block in use.
    pub fn block(&self) -> Option<&ParameterBlock> {
        self.watched.as_ref().map(|watched| watched.controller.block())
    }

    /// Whether the parameters in use still are those that were checked. For
    /// [`Health::parameters_corrupt`], now and then, once a tick's codes are out.
    pub fn parameters_are_whole(&self) -> bool {
        self.watched.as_ref().is_none_or(Watched::is_whole)
    }

    /// Changes the parameters in use as broken memory would; for tests.
    #[cfg(feature = "fault-injection")]
    pub fn break_parameters(&mut self, change: impl FnOnce(&mut ParameterBlock)) {
        if let Some(watched) = &mut self.watched {
            watched.controller.break_block(change);
        }
    }

    /// Leaves Boot: for Disarmed, or for Faulted if there is a cause.
    pub fn booted(&mut self, report: BootReport) {
        if self.state != State::Boot {
            return;
        }
        self.state = State::Disarmed;
        self.home = Home::at_boot(report.position_lost);
        let causes = [
            (report.watchdog_reset, Fault::Watchdog),
            (report.converter_fault, Fault::Converter),
            (report.parameters_corrupt, Fault::CorruptParameters),
        ];
        if report.latched.is_some() {
            self.fault = report.latched;
            self.state = State::Faulted;
        } else if let Some((_, fault)) = causes.into_iter().find(|(is_there, _)| *is_there) {
            self.enter_fault(0, without_figures(fault));
        }
    }

    /// Takes a controller with a checked block in place of the old one; before Boot ends, or Disarmed.
    pub fn replace(&mut self, controller: Controller) -> Result<(), Denied> {
        if !matches!(self.state, State::Boot | State::Disarmed) {
            return Err(self.not_now());
        }
        if self.block().is_some_and(|block| counts_differ(block, controller.block())) {
            self.home.forget();
        }
        self.watched = Some(Watched::new(controller));
        Ok(())
    }

    /// Carries an order out, or says why not.
    pub fn obey(&mut self, order: Order) -> Result<(), Denied> {
        match (order, self.state) {
            (Order::Arm, State::Disarmed) => self.arm(),
            (Order::Run { host_timeout_ticks }, State::Armed) => self.run(host_timeout_ticks),
            (Order::Stop, State::Running) => {
                self.stop(State::Armed);
                Ok(())
            }
            (Order::Disarm, State::Armed | State::Running) => {
                self.stop(State::Disarmed);
                Ok(())
            }
            (Order::Stop, State::Armed) | (Order::Stop | Order::Disarm, State::Disarmed) => Ok(()),
            (Order::ClearFault, State::Faulted) => self.clear_fault(),
            (Order::Home { position }, State::Disarmed) => self.tell_home(&position),
            _ => Err(self.not_now()),
        }
    }

    fn not_now(&self) -> Denied {
        Denied::NotNow { state: self.state }
    }

    fn arm(&mut self) -> Result<(), Denied> {
        if self.health.converter_fault || self.health.parameters_corrupt {
            return Err(Denied::FaultPersists);
        }
        let watched = self.watched.as_ref().ok_or(Denied::NoParameters)?;
        watched.is_plausible()?;
        for (joint, index) in (1..).zip(0..3) {
            let why = self.home.implausible(index).filter(|_| follows(watched.mode[index]));
            if let Some(why) = why {
                return Err(Denied::Implausible { joint, why });
            }
        }
        self.state = State::Armed;
        Ok(())
    }

    fn tell_home(&mut self, position: &[Angle; 3]) -> Result<(), Denied> {
        let watched = self.watched.as_mut().ok_or(Denied::NoParameters)?;
        watched.is_plausible()?;
        self.home.tell(position, watched.controller.block().encoder_counts_per_turn);
        watched.begin_anew();
        Ok(())
    }

    fn run(&mut self, host_timeout_ticks: Option<u32>) -> Result<(), Denied> {
        let watched = self.watched.as_mut().ok_or(Denied::NoParameters)?;
        watched.is_plausible()?;
        watched.is_near_start()?;
        watched.controller.start();
        watched.joints.iter_mut().for_each(JointWatch::begin);
        self.host_timeout_ticks = host_timeout_ticks;
        self.silent_ticks = 0;
        self.state = State::Running;
        Ok(())
    }

    fn stop(&mut self, state: State) {
        self.state = state;
        self.host_timeout_ticks = None;
        if let Some(watched) = &mut self.watched {
            watched.stop();
        }
    }

    fn clear_fault(&mut self) -> Result<(), Denied> {
        if self.health.converter_fault || self.health.parameters_corrupt {
            return Err(Denied::FaultPersists);
        }
        self.fault = None;
        self.state = State::Disarmed;
        Ok(())
    }

    /// Latches the first cause and takes the voltage away.
    fn enter_fault(&mut self, joint: u8, excess: Excess) {
        let Excess { fault, value, limit } = excess;
        let tick = self.counters.ticks;
        self.fault.get_or_insert(FaultRecord { fault, joint, tick, value, limit });
        self.stop(State::Faulted);
    }

    /// What is wrong with the board as a whole.
    #[inline]
    fn board_fault(&self) -> Option<Excess> {
        if self.health.converter_fault && self.state != State::Boot {
            return Some(without_figures(Fault::Converter));
        }
        if self.health.parameters_corrupt && self.state != State::Boot {
            return Some(without_figures(Fault::CorruptParameters));
        }
        if self.health.overrun && matches!(self.state, State::Armed | State::Running) {
            return Some(without_figures(Fault::TickOverrun));
        }
        let most = self.host_timeout_ticks?;
        (self.silent_ticks > most).then(|| self.link_lost(most))
    }

    fn link_lost(&self, most_ticks: u32) -> Excess {
        let period_s = self.watched.as_ref().map_or(0.0, |w| w.controller.block().sample_period_s);
        let seconds = |ticks: u32| ticks as f32 * period_s;
        Excess {
            fault: Fault::LinkLost,
            value: seconds(self.silent_ticks),
            limit: seconds(most_ticks),
        }
    }

    /// Has the controller compute and looks at every joint; the first one (0 to 2) at fault.
    #[inline]
    fn control(&mut self, counts: &[i32; 3]) -> Option<(usize, Fault)> {
        let watched = self.watched.as_mut()?;
        watched.last = watched.controller.tick(counts);
        let running = self.state == State::Running;
        let mut first = None;
        for index in 0..3 {
            let seen = watched.seen(index, counts[index]);
            let joint = &mut watched.joints[index];
            let fault = if running { joint.run(&seen) } else { joint.rest(&seen) };
            let cut = u32::from(seen.saturated);
            self.counters.saturated[index] = self.counters.saturated[index].wrapping_add(cut);
            if fault == Some(Fault::EncoderJump) {
                self.home.doubt(index);
            }
            if let (None, Some(fault)) = (first, fault) {
                first = Some((index, fault));
            }
        }
        // An arm at 0 V that people move about is no fault; it is only not armed.
        first.filter(|_| matches!(self.state, State::Armed | State::Running))
    }

    #[cold]
    fn enter_joint_fault(&mut self, index: usize, fault: Fault, count: i32) {
        if fault == Fault::EncoderStuck {
            self.home.doubt(index);
        }
        let Some(watched) = &self.watched else { return };
        let excess = watched.joints[index].excess(fault, &watched.seen(index, count));
        self.enter_fault(index as u8 + 1, excess);
    }

    /// The tick as the host sees it, whose codes go to the converter.
    #[inline]
    fn record(&self, counts: &[i32; 3]) -> Telemetry {
        let output = self.watched.as_ref().map(|watched| (&watched.last, watched.mode));
        let running = output.filter(|_| self.state == State::Running);
        Telemetry {
            sequence: self.counters.ticks,
            counts: *counts,
            codes: running.map_or([DacCode(0); 3], |(output, _)| output.codes),
            reference: running.map_or([Angle(0); 3], |(output, _)| output.reference),
            mode: output.map_or([Mode::OpenLoop; 3], |(_, mode)| mode),
            state: self.state,
            saturated: running.map_or(0, |(output, _)| bits(&output.saturated)),
            fault: self.fault.map(|record| (record.fault, record.joint)),
            tick_time_tenth_us: self.health.tick_time_tenth_us,
            dropped: 0,
        }
    }
}

fn counts_differ(one: &ParameterBlock, other: &ParameterBlock) -> bool {
    one.encoder_counts_per_turn != other.encoder_counts_per_turn
}

fn without_figures(fault: Fault) -> Excess {
    Excess { fault, value: 0.0, limit: 0.0 }
}

/// Bit i for the i-th flag.
#[inline]
fn bits(flags: &[bool; 3]) -> u8 {
    u8::from(flags[0]) | u8::from(flags[1]) << 1 | u8::from(flags[2]) << 2
}
