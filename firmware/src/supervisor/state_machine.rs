//! The states, and the orders and faults that change them.

use super::counters::TickCounters;
use super::fault::{Fault, FaultRecord, State};
use super::health::{BootReport, Health};
use super::home::Home;
use super::joint_monitor::{LimitViolation, has_reference};
use super::latch::Kept;
use super::monitored_controller::MonitoredController;
use super::orders::{Order, OrderError};
use super::output_monitor::OutputMonitor;
use super::stop_category::{ControlledStop, DriveOutputs, StopCategory};
use crate::{Angle, Controller, ParameterBlock};

/// The controller under supervision.
#[derive(Clone, Debug, Default)]
pub struct Supervisor {
    pub(super) state: State,
    pub(super) fault: Option<FaultRecord>,
    pub(super) monitored: Option<MonitoredController>,
    pub(super) home: Home,
    pub(super) health: Health,
    pub(super) host_timeout_ticks: Option<u32>,
    pub(super) silent_ticks: u32,
    pub(super) controlled_stop: ControlledStop,
    pub(super) outputs: OutputMonitor,
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

    /// What a board that is reset now must know at its next boot.
    #[inline]
    pub fn kept(&self) -> Kept {
        match self.fault {
            Some(record) => Kept::Fault(record),
            None if self.state.enables() => Kept::Armed,
            None => Kept::Nothing,
        }
    }

    /// What has become of the board since the last tick, for the next order.
    pub fn set_health(&mut self, health: Health) {
        self.health = health;
    }

    /// The levels for amplifiers and brakes.
    pub fn drive_outputs(&self) -> DriveOutputs {
        let holds = self.state == State::Stopping && self.controlled_stop.brakes_engage();
        DriveOutputs { enable: self.state.enables(), release_brakes: self.state.drives() && !holds }
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
        self.monitored.as_ref().map(|monitored| monitored.controller.block())
    }

    /// Whether a part of the parameters in use is unchanged since they were checked.
    pub(super) fn part_is_intact(&self, part: usize) -> bool {
        self.monitored.as_ref().is_none_or(|monitored| monitored.part_is_intact(part))
    }

    /// Changes the parameters in use as corrupted memory would; for tests.
    #[cfg(feature = "fault-injection")]
    pub fn corrupt_parameters(&mut self, change: impl FnOnce(&mut ParameterBlock)) {
        if let Some(monitored) = &mut self.monitored {
            monitored.controller.corrupt_block(change);
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
            (report.was_armed && report.supply_failed, Fault::BrownOut),
            (report.was_armed, Fault::Reset),
            (report.converter_fault, Fault::Converter),
            (report.parameters_corrupt, Fault::CorruptParameters),
        ];
        if report.latched.is_some() {
            self.fault = report.latched;
            self.state = State::Faulted;
        } else if let Some((_, fault)) = causes.into_iter().find(|(is_there, _)| *is_there) {
            self.enter_fault(0, LimitViolation::of(fault));
        }
    }

    /// Takes a controller with a checked block in place of the old one; before Boot ends, or Disarmed.
    pub fn replace(&mut self, controller: Controller) -> Result<(), OrderError> {
        if !matches!(self.state, State::Boot | State::Disarmed) {
            return Err(self.not_now());
        }
        if self.block().is_some_and(|block| counts_differ(block, controller.block())) {
            self.home.invalidate_all();
        }
        let fresh = MonitoredController::new(controller);
        self.monitored = Some(match &self.monitored {
            Some(before) => fresh.warmed_as(before),
            None => fresh,
        });
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
            (Order::Home { position }, State::Disarmed) => self.set_home(&position),
            _ => Err(self.not_now()),
        }
    }

    fn not_now(&self) -> OrderError {
        OrderError::NotNow { state: self.state }
    }

    fn arm(&mut self) -> Result<(), OrderError> {
        if self.health.is_unfit() {
            return Err(OrderError::FaultPersists);
        }
        if self.health.emergency_stop {
            return Err(OrderError::EmergencyStop);
        }
        if self.health.drive_power_lost {
            return Err(OrderError::NoDrivePower);
        }
        let monitored = self.monitored.as_ref().ok_or(OrderError::NoParameters)?;
        monitored.is_plausible()?;
        for (joint, index) in (1..).zip(0..3) {
            let is_needed =
                has_reference(monitored.mode[index]) || monitored.joints[index].range().is_there();
            if let Some(why) = self.home.implausible(index).filter(|_| is_needed) {
                return Err(OrderError::Implausible { joint, why });
            }
        }
        self.state = State::Armed;
        Ok(())
    }

    fn set_home(&mut self, position: &[Angle; 3]) -> Result<(), OrderError> {
        let monitored = self.monitored.as_mut().ok_or(OrderError::NoParameters)?;
        monitored.is_plausible()?;
        self.home.set(position, monitored.controller.block().encoder_counts_per_turn);
        monitored.reset();
        Ok(())
    }

    fn run(&mut self, host_timeout_ticks: Option<u32>) -> Result<(), OrderError> {
        let monitored = self.monitored.as_mut().ok_or(OrderError::NoParameters)?;
        monitored.is_plausible()?;
        monitored.is_in_range()?;
        let start = monitored.near_start()?;
        monitored.start(&start);
        self.host_timeout_ticks = host_timeout_ticks;
        self.silent_ticks = 0;
        self.state = State::Running;
        Ok(())
    }

    pub(super) fn stop(&mut self, state: State) {
        self.state = state;
        self.host_timeout_ticks = None;
        if let Some(monitored) = &mut self.monitored {
            monitored.stop();
        }
    }

    fn clear_fault(&mut self) -> Result<(), OrderError> {
        if self.health.is_unfit() {
            return Err(OrderError::FaultPersists);
        }
        self.fault = None;
        self.state = State::Disarmed;
        Ok(())
    }

    /// Latches the first cause, and takes the voltage away or brakes the arm first.
    pub(super) fn enter_fault(&mut self, joint: u8, violation: LimitViolation) {
        let LimitViolation { fault, value, limit } = violation;
        let tick = self.counters.ticks;
        self.fault.get_or_insert(FaultRecord { fault, joint, tick, value, limit });
        match fault.stop_category() {
            StopCategory::Controlled if self.state == State::Running => self.brake(),
            StopCategory::Controlled if self.state == State::Stopping => {}
            _ => self.stop(State::Faulted),
        }
    }

    /// Begins a controlled stop, where every joint can be braked.
    fn brake(&mut self) {
        match &mut self.monitored {
            Some(monitored) if monitored.can_brake() => {
                let period_s = monitored.controller.block().sample_period_s;
                monitored.brake();
                self.controlled_stop = ControlledStop::new(period_s);
                self.host_timeout_ticks = None;
                self.state = State::Stopping;
            }
            _ => self.stop(State::Faulted),
        }
    }
}

fn counts_differ(one: &ParameterBlock, other: &ParameterBlock) -> bool {
    one.encoder_counts_per_turn != other.encoder_counts_per_turn
}
