//! The controller with a monitor on each of its joints.

use super::fault::Fault;
use super::joint_monitor::{JointMonitor, has_reference};
use super::orders::OrderError;
use crate::joint::JointSample;
use crate::{Angle, Controller, DacCode, Mode};

/// A controller and the monitors of its joints.
#[derive(Clone, Debug)]
pub(super) struct MonitoredController {
    pub controller: Controller,
    pub joints: [JointMonitor; 3],
    pub mode: [Mode; 3],
    pub last: [JointSample; 3],
}

impl MonitoredController {
    pub fn new(controller: Controller) -> Self {
        let block = controller.block();
        Self {
            joints: [0, 1, 2].map(|index| JointMonitor::new(block, index)),
            mode: block.mode,
            last: Default::default(),
            controller,
        }
    }

    /// Resets estimators and monitors: the counts have another zero from now on.
    pub fn reset(&mut self) {
        self.controller.reset();
        let block = self.controller.block();
        self.joints = [0, 1, 2].map(|index| JointMonitor::new(block, index));
    }

    /// Whether the block, and what was derived from it once, are unchanged.
    pub fn is_intact(&self) -> bool {
        let block = self.controller.block();
        let has_limits = |index: usize| self.joints[index].has_limits_of(block, index);
        self.controller.is_intact() && self.mode == block.mode && (0..3).all(has_limits)
    }

    /// Whether every joint is at rest and its estimates can be right.
    pub fn is_plausible(&self) -> Result<(), OrderError> {
        for (joint, index) in (1..).zip(0..3) {
            if let Some(why) = self.joints[index].implausible(&self.last[index]) {
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
        let Self { controller, joints, last, .. } = self;
        let mut is_suspicious = false;
        controller.act(counts, last, |index, sample| {
            is_suspicious |= joints[index].is_suspicious(sample, running);
        });
        is_suspicious
    }

    #[inline(never)]
    fn act_at_rest(&mut self, counts: &[i32; 3], running: bool) -> bool {
        self.controller.only_measure(counts, &mut self.last);
        let joints = self.joints.iter_mut().zip(&self.last);
        joints.fold(false, |is, (joint, sample)| is | joint.is_suspicious(sample, running))
    }

    /// What is wrong with joint `index` (0 to 2) in this tick.
    #[cold]
    pub fn fault(&mut self, index: usize, running: bool, brakes: bool) -> Option<Fault> {
        let sample = self.last[index];
        let joint = &mut self.joints[index];
        let fault = joint.fault(&sample, running);
        if fault.is_some() || !running {
            return fault;
        }
        if joint.stall().is_due() && self.is_stalled(index) {
            return Some(Fault::Stalled);
        }
        let leaves = !brakes && self.joints[index].range().is_left_by(&sample);
        leaves.then_some(Fault::PositionLimit)
    }

    /// The rest of a tick, on which no code depends.
    #[inline]
    pub fn complete(&mut self) {
        for (joint, sample) in self.joints.iter_mut().zip(&self.last) {
            joint.complete(sample);
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
