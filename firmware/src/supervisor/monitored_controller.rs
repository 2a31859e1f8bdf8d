//! The controller with a monitor on each of its joints.

use super::fault::Fault;
use super::heat_monitor::HeatMonitor;
use super::joint_monitor::{JointMonitor, has_reference};
use super::orders::OrderError;
use crate::block::PARTS;
use crate::joint::JointSample;
use crate::{Angle, Controller, DacCode, Mode};

/// A controller and the monitors of its joints.
#[derive(Clone, Debug)]
pub(super) struct MonitoredController {
    pub controller: Controller,
    pub joints: [JointMonitor; 3],
    pub mode: [Mode; 3],
    /// The joints that the rig has; what the others' encoders say matters to nobody.
    pub in_use: [bool; 3],
    pub heat: [HeatMonitor; 3],
    /// A motor has had more than it bears.
    is_hot: bool,
    pub last: [JointSample; 3],
}

impl MonitoredController {
    pub fn new(controller: Controller) -> Self {
        let block = controller.block();
        Self {
            joints: [0, 1, 2].map(|index| JointMonitor::new(block, index)),
            mode: block.mode,
            in_use: block.in_use,
            heat: [0, 1, 2].map(|index| HeatMonitor::new(block, index)),
            is_hot: false,
            last: Default::default(),
            controller,
        }
    }

    /// The motors are as warm as they were with the block before.
    pub fn warmed_as(mut self, before: &Self) -> Self {
        for (heat, before) in self.heat.iter_mut().zip(&before.heat) {
            *heat = heat.warmed_as(before);
        }
        self
    }

    /// Resets estimators and monitors: the counts have another zero from now on.
    pub fn reset(&mut self) {
        self.controller.reset();
        let block = self.controller.block();
        self.joints = [0, 1, 2].map(|index| JointMonitor::new(block, index));
    }

    /// Whether a part of the parameters is unchanged: one of the block's, then what was derived
    /// from it once, then the limits of each joint.
    pub fn part_is_intact(&self, part: usize) -> bool {
        let block = self.controller.block();
        match part.checked_sub(PARTS) {
            None => self.controller.part_is_intact(part),
            Some(0) => {
                let same = (self.mode, self.in_use) == (block.mode, block.in_use);
                self.controller.derived_is_intact() && same
            }
            Some(number) => self.joint_is_intact(number - 1),
        }
    }

    fn joint_is_intact(&self, index: usize) -> bool {
        let block = self.controller.block();
        let (Some(joint), Some(heat)) = (self.joints.get(index), self.heat.get(index)) else {
            return true;
        };
        joint.has_limits_of(block, index) && heat.fresh() == HeatMonitor::new(block, index)
    }

    /// Whether every joint is at rest and its estimates can be right.
    pub fn is_plausible(&self) -> Result<(), OrderError> {
        let joints = self.joints.iter().zip(&self.last).zip(self.in_use);
        for (joint, ((monitor, sample), used)) in (1..).zip(joints) {
            if let Some(why) = monitor.implausible(sample).filter(|_| used) {
                return Err(OrderError::Implausible { joint, why });
            }
        }
        Ok(())
    }

    /// Runs the controller; whether something about a joint must be looked at.
    #[inline]
    pub fn act(&mut self, counts: &[i32; 3], running: bool) -> bool {
        if !self.controller.is_running() {
            return self.act_at_rest(counts, running);
        }
        let Self { controller, joints, last, in_use, is_hot, .. } = self;
        let mut is_suspicious = *is_hot;
        controller.act(counts, last, |index, sample| {
            is_suspicious |= joints[index].is_suspicious(sample, running) & in_use[index];
        });
        is_suspicious
    }

    #[inline(never)]
    fn act_at_rest(&mut self, counts: &[i32; 3], running: bool) -> bool {
        self.controller.only_measure(counts, &mut self.last);
        let joints = self.joints.iter_mut().zip(&self.last).zip(self.in_use);
        joints.fold(false, |is, ((joint, sample), used)| {
            is | (joint.is_suspicious(sample, running) & used)
        })
    }

    /// What is wrong with joint `index` (0 to 2) in this tick.
    #[cold]
    pub fn fault(&mut self, index: usize, running: bool, brakes: bool) -> Option<Fault> {
        if !self.in_use[index] {
            return None;
        }
        let sample = self.last[index];
        let joint = &mut self.joints[index];
        let fault = joint.fault(&sample, running);
        if fault == Some(Fault::Saturation) && self.heat[index].is_limiting() {
            // It is the motor that lacks the voltage; the arm is held while it is braked.
            return Some(Fault::MotorTooHot);
        }
        if fault.is_some() || !running {
            return fault;
        }
        if joint.stall().is_due() && self.is_stalled(index) {
            return Some(Fault::Stalled);
        }
        let leaves = !brakes && self.joints[index].range().is_left_by(&sample);
        if leaves {
            return Some(Fault::PositionLimit);
        }
        self.heat[index].is_too_hot().then_some(Fault::MotorTooHot)
    }

    /// The rest of a tick, on which no code depends.
    #[inline]
    pub fn complete(&mut self) {
        for (joint, sample) in self.joints.iter_mut().zip(&self.last) {
            joint.complete(sample);
        }
        self.warm();
    }

    /// Counts what the motors were given, and limits what a warm one gets next.
    #[inline]
    fn warm(&mut self) {
        self.is_hot = false;
        for (index, (heat, sample)) in self.heat.iter_mut().zip(&self.last).enumerate() {
            let limit_v = heat.limit_after(sample.command_v());
            self.is_hot |= heat.is_too_hot();
            self.controller.limit_command(index, limit_v);
        }
    }

    /// Where the reference begins, if every joint that has one is near.
    pub fn near_start(&self) -> Result<[Angle; 3], OrderError> {
        let limits = self.controller.block().safety.start_error_rad;
        let start = self.controller.start_of_reference();
        for (number, index) in (1..).zip(0..3) {
            let distance_rad = start[index].minus(self.last[index].measured);
            if has_reference(self.mode[index]) && distance_rad.abs() > limits[index] {
                return Err(OrderError::FarFromStart { joint: number, distance_rad });
            }
        }
        Ok(start)
    }

    /// Whether every joint that has a range is in it.
    pub fn is_in_range(&self) -> Result<(), OrderError> {
        for (joint, monitor) in (1..).zip(&self.joints) {
            if let Some((position_rad, _)) = monitor.range().outside(monitor.last_count()) {
                return Err(OrderError::OutsideRange { joint, position_rad });
            }
        }
        Ok(())
    }

    /// Whether every joint can be braked by its reference.
    pub fn can_brake(&self) -> bool {
        self.mode.iter().all(|mode| *mode != Mode::FrictionOnly)
    }

    /// Brakes the joints to rest.
    pub fn brake(&mut self) {
        self.controller.brake(&self.last.map(|sample| sample.velocity_rad_per_s));
    }

    /// The voltage at joint `index` (0 to 2) less gravity's, and what friction may hold of it [V].
    #[cold]
    pub fn unbalanced_v(&self, index: usize) -> (f32, f32) {
        let command_v = self.last[index].command_v();
        // A joint without a reference may not know where it is.
        let posture = [0, 1, 2].map(|i| match has_reference(self.mode[i]) {
            true => self.last[i].measured,
            false => self.last[i].reference,
        });
        let net_v = command_v - self.controller.gravity_v(&posture)[index];
        (net_v.abs(), self.joints[index].stall_limit_v())
    }

    /// Whether joint `index` (0 to 2), which stands under a voltage, does not stand by itself.
    #[cold]
    pub fn is_stalled(&mut self, index: usize) -> bool {
        let (net_v, limit_v) = self.unbalanced_v(index);
        let is_stalled = net_v > limit_v;
        if !is_stalled {
            self.joints[index].stall().moves();
        }
        is_stalled
    }

    /// Begins the reference, without a step of the feedback where the joints are off its start.
    pub fn start(&mut self, start: &[Angle; 3]) {
        self.controller.start_from(start, &self.last.map(|sample| sample.measured));
        self.joints.iter_mut().for_each(JointMonitor::begin_run);
    }

    /// Sets the codes to 0 V, in this tick too.
    pub fn stop(&mut self) {
        self.controller.stop();
        for sample in &mut self.last {
            (sample.code, sample.saturated) = (DacCode(0), false);
        }
    }
}
