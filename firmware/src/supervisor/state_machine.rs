//! The states, and the orders and faults that change them.

use super::counters::TickCounters;
use super::fault::{Fault, FaultRecord, State};
use super::health::{BootReport, Health};
use super::home::Home;
use super::joint_monitor::{Excess, JointMonitor, follows};
use super::monitored_controller::MonitoredController;
use super::orders::{Order, OrderError};
use crate::{Angle, Controller, ParameterBlock};

/// Every so many ticks a board asks [`Supervisor::parameters_are_whole`].
pub const CHECK_EVERY_TICKS: u32 = 1000;

/// The controller under watch.
#[derive(Clone, Debug, Default)]
pub struct Supervisor {
    pub(super) state: State,
    pub(super) fault: Option<FaultRecord>,
    pub(super) watched: Option<MonitoredController>,
    pub(super) home: Home,
    pub(super) health: Health,
    pub(super) host_timeout_ticks: Option<u32>,
    pub(super) silent_ticks: u32,
    pub(super) counters: TickCounters,
}

impl Supervisor {
    /// What it is doing.
    pub fn state(&self) -> State {
        self.state
    }

    /// The first cause, while Faulted.
    pub fn fault(&self) -> Option<FaultRecord> {
        self.fault
    }

    /// What it has counted since power-on; saturation included.
    pub fn counters(&self) -> &TickCounters {
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
        self.watched.as_ref().is_none_or(MonitoredController::is_whole)
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
            self.enter_fault(0, Excess::of(fault));
        }
    }

    /// Takes a controller with a checked block in place of the old one; before Boot ends, or Disarmed.
    pub fn replace(&mut self, controller: Controller) -> Result<(), OrderError> {
        if !matches!(self.state, State::Boot | State::Disarmed) {
            return Err(self.not_now());
        }
        if self.block().is_some_and(|block| counts_differ(block, controller.block())) {
            self.home.forget();
        }
        self.watched = Some(MonitoredController::new(controller));
        Ok(())
    }

    /// Carries an order out, or says why not.
    pub fn execute(&mut self, order: Order) -> Result<(), OrderError> {
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

    fn not_now(&self) -> OrderError {
        OrderError::NotNow { state: self.state }
    }

    fn arm(&mut self) -> Result<(), OrderError> {
        if self.health.converter_fault || self.health.parameters_corrupt {
            return Err(OrderError::FaultPersists);
        }
        let watched = self.watched.as_ref().ok_or(OrderError::NoParameters)?;
        watched.is_plausible()?;
        for (joint, index) in (1..).zip(0..3) {
            let why = self.home.implausible(index).filter(|_| follows(watched.mode[index]));
            if let Some(why) = why {
                return Err(OrderError::Implausible { joint, why });
            }
        }
        self.state = State::Armed;
        Ok(())
    }

    fn tell_home(&mut self, position: &[Angle; 3]) -> Result<(), OrderError> {
        let watched = self.watched.as_mut().ok_or(OrderError::NoParameters)?;
        watched.is_plausible()?;
        self.home.tell(position, watched.controller.block().encoder_counts_per_turn);
        watched.begin_anew();
        Ok(())
    }

    fn run(&mut self, host_timeout_ticks: Option<u32>) -> Result<(), OrderError> {
        let watched = self.watched.as_mut().ok_or(OrderError::NoParameters)?;
        watched.is_plausible()?;
        watched.is_near_start()?;
        watched.controller.start();
        watched.joints.iter_mut().for_each(JointMonitor::begin);
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

    fn clear_fault(&mut self) -> Result<(), OrderError> {
        if self.health.converter_fault || self.health.parameters_corrupt {
            return Err(OrderError::FaultPersists);
        }
        self.fault = None;
        self.state = State::Disarmed;
        Ok(())
    }

    /// Latches the first cause and takes the voltage away.
    pub(super) fn enter_fault(&mut self, joint: u8, excess: Excess) {
        let Excess { fault, value, limit } = excess;
        let tick = self.counters.ticks;
        self.fault.get_or_insert(FaultRecord { fault, joint, tick, value, limit });
        self.stop(State::Faulted);
    }
}

fn counts_differ(one: &ParameterBlock, other: &ParameterBlock) -> bool {
    one.encoder_counts_per_turn != other.encoder_counts_per_turn
}
